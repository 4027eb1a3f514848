#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "debug/branch_record.h"
#include "debug/field_frame.h"
#include "recording/playback.h"

namespace mrose {

/// A place in a branch, and what the last ticks reported there: what robots observed and decided, kicks, contacts,
/// messages.
class Cursor {
public:
    Cursor(std::uint32_t branch, ReachedState at);

    std::uint32_t branch() const { return branch_; }
    std::int64_t tick() const { return at_.state.tick; }
    const WorldState& state() const { return at_.state; }
    /// Why the last tick asks to stop here; empty: it does not.
    const std::string& breakReason() const { return breakReason_; }

    /// Of the tick that led here; nullptr: none is known.
    const StepTrace* trace() const { return hasTrace_ ? &trace_ : nullptr; }

    /// One tick on along a timeline where it has been before.
    Expected<void> advance(const BranchRecord& record, const Timeline& timeline);
    /// One tick on that has never been.
    const StepTrace& step(BranchRecord& record, StepBuffers& buffers);
    /// A state of another branch. Where it follows on from this one, what robots saw and decided stays known.
    void moveTo(std::uint32_t branch, ReachedState at, bool follows);
    /// What each robot last saw and decided.
    const std::vector<RobotInsight>& insights() const { return insights_; }

    /// State, insights, contacts, kicks and messages; nothing of other ticks.
    FieldFrame frame(std::shared_ptr<const Scenario> scenario) const;
    /// The same for reading numbers, `reality` beside it if it is known; valid until the next tick.
    Moment moment(const Scenario& scenario, const Reality* reality) const;

private:
    void note(const BranchRecord& record);
    void noteInsightsAtStart(const BranchRecord& record);
    void forgetNotes();

    std::uint32_t branch_;
    ReachedState at_;
    StepTrace trace_;
    std::vector<std::byte> memoryBefore_;  ///< of all controllers, before the last tick
    bool hasTrace_ = false;
    std::vector<RobotInsight> insights_;
    struct SeenKick {
        std::int64_t tick;
        StepTrace::Kicked kick;
    };
    std::vector<SeenKick> kicks_;
    RadioLog radio_;
    std::string breakReason_;
};

/// So long a kick is shown.
inline constexpr Nanoseconds kickShown = nanosecondsPerSecond * 3 / 10;

}  // namespace mrose
