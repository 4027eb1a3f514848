#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "debug/live_run.h"
#include "session/requests.h"

namespace mrose::gui {

/// The thread in which the window's run lives. It plays in real time; what is asked for is carried out by the run's
/// debugger and answered by shown(), in the thread of the window, in order. A seek takes the place of one that was
/// asked for just before and has not begun.
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
    std::uint64_t open(const OpenedRun& run);
    const std::string& runName() const { return runName_; }       ///< of the one that was opened last
    std::uint64_t newestRun() const { return requests_.runs(); }  ///< its number
    /// Something of the run's debugger, which is quick. Nothing where there is no run, or another than `ofRun`, by its
    /// number.
    void ask(std::function<void(Debugger&)> what, std::optional<std::uint64_t> ofRun = {});
    void play() { ask(&Debugger::play); }
    void pause();
    /// Simulated seconds per second; 0: as fast as possible.
    void setSpeed(double speed);
    /// As Debugger::goTo(); whatever is asked for meanwhile ends a long way.
    void seek(std::int64_t tick, bool breaks = false);
    /// A branch, which stands at its beginning; then to `seek`, if that is later. Once it is there `begun` is called,
    /// in the session's thread.
    void branchOff(const Edit& edit, std::optional<std::int64_t> seek = {}, std::function<void()> begun = {});
    /// As Debugger::goToBreak(), as fast as possible. Only cancel() ends it, and another run.
    void goToBreak(const BreakWish& wish, BreakReach reach = BreakReach::on);
    void changeBreakpoints(std::function<void(Breakpoints&)> change) {
        ask([change = std::move(change)](Debugger& debugger) { change(debugger.breakpoints()); });
    }
    void setBreakpoints(const std::vector<Breakpoint>& breakpoints) {
        changeBreakpoints([breakpoints](Breakpoints& all) { all.replace(breakpoints); });
    }
    void stepBy(std::int64_t ticks) {
        ask([ticks](Debugger& debugger) { debugger.stepBy(ticks); });
    }
    void show(std::uint32_t branch, std::int64_t tick) {
        ask([branch, tick](Debugger& debugger) { debugger.show(branch, tick); });
    }
    /// What really happened beside a run, by its number; of another run it is left out.
    void setReality(std::uint64_t run, std::shared_ptr<const Reality> reality) {
        ask([reality = std::move(reality)](Debugger& debugger) { debugger.setReality(reality); }, run);
    }
    /// What frames are made with; for those whom its thread calls.
    const FrameOptions& frameOptions() const { return frameOptions_; }
    void setFrameOptions(const FrameOptions& options);

    /// Long work over the run, in the session's thread: meanwhile nothing is stepped. What
    /// `finishes` is not ended by another run, which waits for it.
    void doLongWork(const QString& what, std::function<void(TimeTravel&, const Progress&)> job, bool finishes = false);
    /// Writes the run to a file from now on, with all that was before; recordingChanged() reports how that goes.
    void record(const QString& path, const QString& commandLine, bool overwrite);
    void stopRecording();
    /// Ends what takes long, or waits for its turn: a job, a search, the way to a tick. False: there is none.
    bool cancel() { return requests_.cancel(); }

    /// Lets another thread look at the run between two ticks, in the session's thread and for at most some
    /// milliseconds, however busy it is. `run` counts openings. Nothing is given where there is no run, or the session
    /// ends.
    using Look = std::function<void(TimeTravel* travel, std::uint64_t run)>;
    void look(const Look& what);
    /// Whether something is under way that was asked for, or a tick.
    bool busy() const { return requests_.busy(); }

    /// What was shown last; null: nothing yet. In the window's thread.
    const std::shared_ptr<const Shown>& current() const { return current_; }

    /// Blocks until all requests so far have been carried out and shown; for scripts and tests.
    void settle();

signals:
    void opening(const OpenedRun& run);  ///< it is the session's from now on, and shown soon
    void shown(std::shared_ptr<const Shown> what);
    void working(const QString& what, double share);  ///< share 1: it has ended
    /// The file that is written now; empty: none. `error`: why one was not begun, or ended before it was asked to.
    void recordingChanged(const QString& path, const QString& error);
    /// Something that was under way, in any thread, has come to nothing; the session goes on without it.
    void failed(const QString& error);

private:
    void work();
    void goTo(std::int64_t tick, bool breaks);
    Progress progressOf(const QString& what, bool finishes = false);
    Watch watch(Progress goesOn);
    void serveLooks();
    void giveUp(const Error& error);
    void publish();
    void deliver();

    // The window's thread's.
    std::shared_ptr<const Shown> current_;
    std::string runName_;

    // The thread's own.
    LiveRun live_;
    Debugger& debugger_ = live_.debugger();
    std::uint64_t runNumber_ = 0;
    FrameOptions frameOptions_;
    bool quits_ = false;

    // Shared.
    Requests requests_;
    std::mutex mutex_;
    std::shared_ptr<const Shown> ready_;
    bool deliveryPending_ = false;

    std::thread worker_;
};

}  // namespace mrose::gui
