#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "debug/breakpoints.h"
#include "debug/shown.h"
#include "debug/time_travel.h"
#include "io/progress.h"

namespace mrose {

/// How far a break is looked for.
enum class BreakReach {
    on,      ///< from the shown tick; where there is none it goes on to where playing ends, and then beyond
    within,  ///< the same, but no farther than to where playing ends, and without one it stays where it was
    all      ///< of the last one: from where playing ends, up to which is simulated first
};

/// How a long way is watched.
struct Watch {
    /// Asked now and then with the share that is done; false: it is to end. May be empty.
    Progress goesOn = {};
    /// Called now and then between two ticks of the way: what is shown may be taken then. May be empty.
    std::function<void()> between = {};
};

/// A run under a debugger: gone through in both directions, stopped by breakpoints, branched. What a user asks for is a
/// function here, which returns once it is done; what came of it, or went wrong, is said in Shown::message. It knows no
/// thread, no clock and no window: a program that has those lets it play tick by tick.
class Debugger {
public:
    Debugger() = default;
    explicit Debugger(const OpenedRun& run) { open(run); }

    /// Another run, standing at its start. Its breakpoints are none but breakHere().
    void open(const OpenedRun& run);
    bool isOpen() const { return run_.has_value(); }
    // All that follows is for a run that is open.

    TimeTravel& run() { return *run_; }
    const TimeTravel& run() const { return *run_; }
    Breakpoints& breakpoints() { return breakpoints_; }
    bool playing() const { return playing_; }
    const std::string& message() const { return message_; }
    bool atBreak() const { return atBreak_; }

    /// Steps and stands; backwards where negative.
    void stepBy(std::int64_t ticks);
    /// To a tick that has been, or by simulating up to one that has not. It goes on playing if it was. Breakpoints on
    /// the way do not stop it, unless `breaks`.
    void goTo(std::int64_t tick, bool breaks, const Watch& watch = {});
    void show(std::uint32_t branch, std::int64_t tick);
    /// A branch, which stands at its beginning. False: it could not begin.
    bool branchOff(const Edit& edit);
    /// What is said once branchOff() is done.
    void sayBranched();
    void undo();
    void redo();
    void removeBranch(std::uint32_t branch);
    void removeOtherBranches();
    void restoreBranches();
    /// To where the controller decided on the last kick; Shown::subject is its robot.
    void showCauseOfKick();
    /// To where a breakpoint stops next, or to where one was met last. RunEvent::noBreak: there was none.
    void goToBreak(const BreakWish& wish, BreakReach reach = BreakReach::on, const Watch& watch = {});
    /// What really happened beside it.
    void setReality(std::shared_ptr<const Reality> reality);

    void play();
    /// Playing, and whatever was said, ends.
    void stop(const std::string& why = {});
    void say(const std::string& what) { message_ = what; }
    /// Playing stops at that tick, instead of where the scenario says; it can go on from there.
    void stopAt(std::int64_t tick) { end_ = tick; }
    /// Whether it is not yet known if it is to stop at the shown tick: how often something was met before takes a
    /// search, which was ended.
    bool waits() const { return waiting_ == std::pair(run_->branch(), run_->tick()); }
    /// Playing, one tick on; where it waits, that search goes on instead. False of `goesOn` ends it.
    void playOn(const Progress& goesOn = {});

    /// Looks where breakpoints were met, at some more ticks; whether there are more.
    Expected<bool> learnBreaks() { return breakpoints_.learn(*run_); }

    /// All of the shown tick. What is reported once is not in the next.
    Shown takeShown(const FrameOptions& options = {});

private:
    bool stopsHere(const Progress& goesOn);
    void arrive(const Progress& goesOn);
    void goToStop(const Breakpoints::Answer& answer, const std::string& none, bool ended);
    void runToBreak(BreakReach reach, const Watch& watch);
    void simulateToBreak(std::int64_t end, const Watch& watch);
    void backToBreak(const BreakWish& wish, BreakReach reach, const Watch& watch);
    Expected<void> simulateToEnd(const Watch& watch);
    std::int64_t playsTo() const;
    std::string secondsAt(std::int64_t tick) const;

    std::optional<TimeTravel> run_;
    Breakpoints breakpoints_;
    bool playing_ = false;
    std::optional<std::int64_t> end_;  ///< where playing stops
    /// Branch and tick at which playing waits to know whether to stop there.
    std::optional<std::pair<std::uint32_t, std::int64_t>> waiting_;
    std::string message_;
    bool atBreak_ = false;             ///< a breakpoint stopped it at the shown tick
    RunEvent event_ = RunEvent::none;  ///< that has not been reported yet
    std::optional<std::size_t> subject_;
    std::optional<std::int64_t> goal_;

    using Marks = std::shared_ptr<const std::vector<TimelineMark>>;
    Marks happened_, marks_;  ///< with breakpoints' in the second; they are made again where something has changed:
    std::uint32_t marksOf_ = 0;
    std::size_t marksKnown_ = 0;
    std::uint64_t marksBreaks_ = 0;
};

}  // namespace mrose
