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

#include "debug/breakpoints.h"
#include "debug/run_recorder.h"
#include "debug/time_travel.h"
#include "session/shown.h"

namespace mrose::gui {

/// The only owner of a running simulation. Its thread steps; requests are answered by shown(), in the thread of the
/// window, in their order. A seek takes the place of one that was asked for just before and has not begun.
class Session final : public QObject {
    Q_OBJECT

public:
    explicit Session(QObject* parent = nullptr);
    ~Session() override;
    /// Ends its thread, and closes the recording; as the destructor, but from another thread. Later requests are not
    /// carried out.
    void quit();

    /// Another run, standing at its start. It ends what takes long in the one before, but for what `finishes`. The
    /// number that Shown::run will have.
    std::uint64_t open(const OpenRun& run);
    void play();
    void pause();
    /// Simulated seconds per second; 0: as fast as possible.
    void setSpeed(double speed);
    /// Playing stops at that tick, instead of where the scenario says; it can go on from there.
    void stopAt(std::int64_t tick);
    void stepBy(std::int64_t ticks);  ///< and stand there; backwards where negative
    /// Goes on playing if it was. It arrives at that tick: breakpoints on the way do not stop it, unless `mayBreak`.
    void seek(std::int64_t tick, bool breaks = false);
    void show(std::uint32_t branch, std::int64_t tick);
    /// A branch, which stands at its beginning; then to `seek`, if that is later. Once it is there `begun` is called,
    /// in the session's thread. What goes wrong is in Shown::message.
    void branchOff(const Edit& edit, std::optional<std::int64_t> seek = {}, std::function<void()> begun = {});
    void showBeside(std::optional<std::uint32_t> branch);
    void rename(std::uint32_t branch, const QString& name);
    void undo();
    void redo();
    /// To where the controller decided on the last kick; Shown::subject is its robot.
    void showCauseOfKick();
    std::uint64_t newestRun() const { return opened_; }  ///< the number of the one that was opened last
    /// What really happened beside the run that was opened as the `run`th; of another run it is left out.
    void setReality(std::uint64_t run, std::shared_ptr<const Reality> reality);
    void setFrameOptions(const TimeTravel::FrameOptions& options);

    // Breakpoints are the run's: another one that is opened has none but breakHere(). Shown::breakpoints has them.

    void setBreakpoints(const std::vector<Breakpoint>& breakpoints);
    void addBreakpoint(const Breakpoint& breakpoint);
    void changeBreakpoint(const Breakpoint& breakpoint);  ///< the one with its number
    void removeBreakpoint(std::uint32_t id);
    void enableBreakpoints(bool enabled);
    /// What "divergence" waits for; empty: no log is laid over.
    void setDivergence(Breakpoints::DivergenceQuestion diverged);
    /// The run is one of several that follow each other. As setBreakpoints(), of the run that is open.
    void setHitsInOtherRuns(const HitsInOtherRuns& met);
    /// How far a break is looked for.
    enum class BreakReach {
        on,      ///< from the shown tick; where there is none it goes on to where playing ends, and then beyond
        within,  ///< the same, but no farther than to where playing ends, and without one it stays where it was
        all      ///< of the last one: from where playing ends, up to which is simulated first
    };
    /// As fast as possible to where a breakpoint stops next, or to where one was met last. Only cancel() ends it, and
    /// another run. RunEvent::noBreak: there was none.
    void goToBreak(const BreakWish& wish, BreakReach reach = BreakReach::on);

    /// Called now and then with the share that is done; false: it is to end.
    using Progress = std::function<bool(double share)>;
    /// Long work over the run, in the session's thread: meanwhile nothing is stepped. `job` returns what is to be said.
    /// What `finishes` is not ended by another run, which waits for it.
    void doLongWork(const QString& what, std::function<QString(TimeTravel&, const Progress&)> job,
                    bool finishes = false);
    /// Writes the run to a file from now on, with all that was before; recordingChanged() reports how that goes.
    void record(const QString& path, const QString& commandLine, bool overwrite);
    void stopRecording();
    /// Ends what takes long, or waits for its turn: a job, a search, the way to a tick. False: there is none.
    bool cancel();

    /// Lets another thread look at the run between two ticks, in the session's thread and for at most some
    /// milliseconds, however busy it is. `run` counts openings. Nothing is given where there is no run, or the session
    /// ends.
    using Look = std::function<void(TimeTravel* travel, std::uint64_t run)>;
    void look(Look what);
    // For those whom its thread calls: what frames are made with, and which run is open, as Shown::run.
    const TimeTravel::FrameOptions& frameOptions() const { return frameOptions_; }
    std::uint64_t runNumber() const { return runNumber_; }
    /// Whether something is under way that was asked for, or a tick.
    bool busy();
    /// What work in any thread threw becomes failed().
    void reportFailure(const Error& error);

    /// Blocks until all requests so far have been carried out and shown; for scripts and tests.
    void settle();

signals:
    void shown(std::shared_ptr<const Shown> what);
    void working(const QString& what, double share);  ///< share 1: it has ended
    /// The file that is written now; empty: none. `error`: why one was not begun, or ended before it was asked to.
    void recordingChanged(const QString& path, const QString& error);
    /// Something that was under way has come to nothing; the session goes on without it.
    void failed(const QString& error);

private:
    enum class Kind { quick, lasting, seek };
    struct Request {
        std::function<void()> carryOut;
        Kind kind = Kind::quick;
        std::uint64_t cancels = 0, opened = 0;  ///< those before it
    };
    void request(std::function<void()> what, Kind kind = Kind::quick);
    void carryOut(const Request& request);
    void work();
    bool turn(bool changed);
    void giveUp(const Error& error);
    bool playTicks();
    bool learn();
    void followRecording();
    void endRecording(const Expected<void>& done);
    void goTo(std::int64_t tick, bool breaks = true);
    bool stopsHere(const Progress& goesOn);
    bool countsHere() const;
    void goToStop(const Breakpoints::Answer& answer, const QString& none);
    void runToBreak(BreakReach reach, const Progress& progress);
    void simulateToBreak(std::int64_t end, const Progress& progress);
    void backToBreak(const BreakWish& wish, BreakReach reach, const Progress& progress);
    Expected<void> simulateToEnd(const Progress& progress);
    Progress progressOf(const QString& what, bool finishes = false);
    bool cancelled() const { return quit_ || cancels_ != cancelsBefore_; }
    bool ended() const { return cancelled() || opened_ != openedBefore_; }
    bool learnBreaks();
    bool superseded();
    void serveLooks();
    void anchor();
    void stop(const QString& why);
    void publish();
    void deliver();

    // The worker's own.
    std::optional<TimeTravel> run_;
    std::uint64_t runNumber_ = 0;
    std::uint64_t cancelsBefore_ = 0, openedBefore_ = 0;  ///< when what is carried out was asked for
    bool learning_ = false;                               ///< there are ticks of a file that have not been looked at
    Breakpoints breakpoints_;
    bool atBreak_ = false;             ///< one of them stopped it at the shown tick
    RunEvent event_ = RunEvent::none;  ///< that has not been reported yet
    bool judging_ = false;             ///< there may be ticks of which breakpoints do not know whether they are met
    /// Branch and tick at which playing waits to know whether to stop there.
    std::optional<std::pair<std::uint32_t, std::int64_t>> counting_;
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
    std::size_t lasting_ = 0;                 ///< requests that are not quick and not done yet
    std::atomic<std::uint64_t> cancels_ = 0;  ///< how often something was to be ended
    std::atomic<std::uint64_t> opened_ = 0;   ///< how many runs
    std::atomic<bool> quit_ = false;
    bool busy_ = false;
    std::shared_ptr<const Shown> ready_;
    bool deliveryPending_ = false;

    std::thread worker_;
};

}  // namespace mrose::gui
