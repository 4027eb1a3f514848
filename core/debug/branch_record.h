#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/controller.h"
#include "debug/branch_setup.h"
#include "debug/field_frame.h"
#include "debug/pose_track.h"
#include "debug/timeline_mark.h"
#include "recording/playback.h"
#include "simulation/touch_counter.h"

namespace mrose {

/// Orders given by hand: instead of asking a robot's controller, for a while.
struct HandOrder {
    std::uint32_t robot = 0;
    std::int64_t first = 0, end = 0;  ///< ticks: from the control instant at or after `first`, before `end`
    Command command;
    std::vector<Kick> kicks;  ///< at its first control instant
};

/// That a controller ordered a kick, or that the robot carried it out.
struct KickEvent {
    std::int64_t tick = 0;  ///< in which it happened: that of the state before
    std::uint32_t robot = 0, manipulator = 0;
    Nanoseconds due = 0;  ///< when it is carried out, if the manipulator is ready
};

/// What is known of a branch beside its timeline: where all bodies were and what happened, for trails, ghosts and
/// marks; and how it goes on.
class BranchRecord {
public:
    BranchRecord(BranchSetupPointer setup, const WorldState& start, std::vector<HandOrder> orders);

    const BranchSetup& setup() const { return *setup_; }
    const BranchSetupPointer& setupPointer() const { return setup_; }
    Playback& playback() const { return playback_; }
    const PoseTrack& track() const { return track_; }
    PoseTrack& track() { return track_; }
    const std::vector<TimelineMark>& marks() const { return marks_; }
    const std::vector<KickEvent>& orderedKicks() const { return orderedKicks_; }
    const std::vector<KickEvent>& carriedOutKicks() const { return carriedOutKicks_; }
    /// When a robot first had a fault of these words.
    struct FirstFault {
        std::int64_t tick = 0;  ///< of the state after it
        std::uint32_t robot = 0;
        std::string what;
        bool operator==(const FirstFault&) const = default;
    };
    const std::vector<FirstFault>& faults() const { return faults_; }
    /// What a robot observed and remembered where the branch begins, before it gets another command.
    struct InsightAtStart {
        std::uint32_t robot = 0;
        RobotInsight insight;
    };
    const std::vector<InsightAtStart>& insightsAtStart() const { return insightsAtStart_; }
    void setInsightsAtStart(std::vector<InsightAtStart> insightsAtStart) {
        insightsAtStart_ = std::move(insightsAtStart);
    }
    /// Who touched before it began: such a contact goes on and is none of its own.
    void setTouches(TouchCounter touches) { touches_ = std::move(touches); }
    const std::vector<HandOrder>& orders() const { return orders_; }
    /// What is decided from outside in the tick that begins with `state`. Valid until the next call.
    Overrides overrides(const WorldState& state);

    /// The last tick that is known here; the timeline may be longer.
    std::int64_t last() const { return end_.state.tick; }
    const WorldState& end() const { return end_.state; }
    /// A tick that came to be at the end.
    void add(const WorldState& after, const StepTrace& trace);
    /// At most `ticks` of a timeline that is longer than what is known; whether there are more.
    Expected<bool> learn(const Timeline& timeline, std::int64_t ticks);

private:
    void note(const WorldState& after, const StepTrace& trace);

    BranchSetupPointer setup_;
    mutable Playback playback_;  ///< how it reaches a tick makes no difference
    PoseTrack track_;
    std::vector<TimelineMark> marks_;
    std::vector<KickEvent> orderedKicks_, carriedOutKicks_;
    std::vector<FirstFault> faults_;
    TouchCounter touches_;
    ReachedState end_;
    StepTrace trace_;
    std::vector<HandOrder> orders_;
    std::vector<InsightAtStart> insightsAtStart_;
    std::vector<RobotDecision> decisions_;  ///< of overrides()
};

}  // namespace mrose
