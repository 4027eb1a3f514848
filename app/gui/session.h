#pragma once

#include <QObject>
#include <QString>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "breakpoints.h"
#include "run_recorder.h"
#include "shown.h"
#include "time_travel.h"

namespace mrose::gui {

/// The only owner of a running simulation. Its thread steps; requests are answered by shown(), in the thread of the
/// window. A seek that comes before an earlier one was done takes its place.
class Session final : public QObject {
    Q_OBJECT

public:
    explicit Session(QObject* parent = nullptr);
    ~Session() override;

    /// Another run, standing at its start.
    void open(const OpenRun& run);
    void play();
    void pause();
    /// Simulated seconds per second; 0: as fast as possible.
    void setSpeed(double speed);
    /// Playing stops at that tick, instead of where the scenario says; it can go on from there.
    void stopAt(std::int64_t tick);
    void stepBy(std::int64_t ticks);  ///< and stand there; backwards where negative
    /// Goes on playing if it was. On the way through what has not yet been simulated breakpoints stop it, if they may.
    void seek(std::int64_t tick, bool breaks = true);
    void show(std::uint32_t branch, std::int64_t tick);
    /// A branch, which stands at its beginning; then to `seek`, if that is later. What goes wrong is in Shown::message.
    void branchOff(const Edit& edit, std::optional<std::int64_t> seek = {});
    void showBeside(std::optional<std::uint32_t> branch);
    void rename(std::uint32_t branch, const QString& name);
    void undo();
    void redo();
    /// To where the controller decided the last kick; Shown::subject is its robot.
    void showCauseOfKick();
    /// What really happened beside the run that was opened as the `run`th; of another run it is left out.
    void setReality(std::uint64_t run, std::shared_ptr<const Reality> reality);
    void setFrameOptions(const TimeTravel::FrameOptions& options);

    // Breakpoints are the run's: another one that is opened has none but breakHere(). Shown::breakpoints tells of them.

    void setBreakpoints(const std::vector<Breakpoint>& breakpoints);
    void addBreakpoint(const Breakpoint& breakpoint);
    void changeBreakpoint(const Breakpoint& breakpoint);  ///< the one with its number
    void removeBreakpoint(std::uint32_t id);
    void enableBreakpoints(bool enabled);
    /// What "divergence" waits for; empty: no log is laid over.
    void setDivergence(TickPredicate diverged);
    /// As fast as possible to where a breakpoint stops next; without one to where playing ends. Only cancel() ends it.
    void runToBreak();
    /// To where one was met last.
    void backToBreak();
    /// To where such a text was met last, whether it is a breakpoint or not.
    void backToLast(const QString& text);

    /// Told now and then which share is done; false: it is to end.
    using Progress = std::function<bool(double share)>;
    /// Long work over the run, in the session's thread: meanwhile nothing is stepped. `job` returns what is to be said.
    void run(const QString& what, std::function<QString(TimeTravel&, const Progress&)> job);
    /// Writes the run to a file from now on, with all that was before; recordingChanged() tells how that goes.
    void record(const QString& path, const QString& commandLine, bool overwrite);
    void stopRecording();
    /// Ends what takes long: a job, or the way to a tick.
    void cancel();

    /// Lets another thread look at the run between two ticks, in the session's thread and for at most some
    /// milliseconds, however busy it is. `run` counts openings. Nothing is given where there is no run, or the session
    /// ends.
    using Look = std::function<void(TimeTravel* travel, std::uint64_t run)>;
    void look(Look what);
    // For those whom its thread calls: what frames are made with, and how many runs were opened.
    const TimeTravel::FrameOptions& frameOptions() const { return frameOptions_; }
    std::uint64_t runs() const { return runs_; }
    /// Whether something is under way that was asked for, or a tick.
    bool busy();

    /// Blocks until all requests so far have been carried out and shown; for scripts and tests.
    void settle();

signals:
    void shown(std::shared_ptr<const Shown> what);
    void working(const QString& what, double share);  ///< share 1: it has ended
    /// The file that is written now; empty: none. `error`: why one was not begun, or ended before it was asked to.
    void recordingChanged(const QString& path, const QString& error);

private:
    using Request = std::function<void()>;
    void request(Request what);
    void work();
    bool playTicks();
    bool learn();
    void followRecording();
    void endRecording(const Expected<void>& done);
    void goTo(std::int64_t tick, bool breaks = true);
    bool stopsHere();
    void goToStop(const Breakpoints::Answer& answer, const QString& none);
    void simulateToBreak(const Progress& progress);
    Progress progressOf(const QString& what);
    bool learnBreaks();
    bool superseded();
    void serveLooks();
    void anchor();
    void stop(const QString& why);
    void publish();
    void deliver();

    // The worker's own.
    std::optional<TimeTravel> run_;
    std::uint64_t runs_ = 0;  ///< opened so far
    bool learning_ = false;   ///< there are ticks of a file that nobody has looked at
    Breakpoints breakpoints_;
    bool atBreak_ = false;  ///< one of them stopped it at the shown tick
    bool judging_ = false;  ///< there may be ticks of which breakpoints do not know whether they are met
    std::optional<RunRecorder> recorder_;
    bool recording_ = false;  ///< there are ticks that it has not yet written
    std::chrono::steady_clock::time_point nextFlush_;
    std::optional<std::int64_t> end_;  ///< where playing stops
    std::optional<std::int64_t> goal_;
    std::optional<std::size_t> subject_;
    TimeTravel::FrameOptions frameOptions_;
    bool playing_ = false;
    double speed_ = 1;
    std::chrono::steady_clock::time_point anchor_;  ///< when the tick `anchorTick_` was due
    std::int64_t anchorTick_ = 0;
    std::chrono::steady_clock::time_point measuredAt_;
    std::int64_t measuredTick_ = 0;
    double factor_ = 0;
    QString message_;
    std::shared_ptr<const std::vector<TimelineMark>> marks_;
    std::uint32_t marksOf_ = 0;
    std::size_t marksKnown_ = 0;
    std::uint64_t marksBreaks_ = 0;
    std::shared_ptr<const std::vector<TimelineMark>> happened_;  ///< those that are no breakpoints'

    // Shared.
    std::mutex mutex_;
    std::condition_variable wake_, settled_;
    std::deque<Request> requests_;
    std::deque<Look> looks_;
    std::optional<std::int64_t> seekTo_;
    bool seekBreaks_ = true;
    std::atomic<bool> quit_ = false;
    bool busy_ = false;
    std::atomic<bool> cancelled_ = false;
    std::shared_ptr<const Shown> ready_;
    bool deliveryPending_ = false;

    std::thread worker_;
};

}  // namespace mrose::gui
