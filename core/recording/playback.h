#pragma once

#include "io/error.h"
#include "recording/timeline.h"
#include "scenario/scenario.h"
#include "scenario/state_validation.h"
#include "simulation/step.h"

namespace mrose {

/// A state that was reached again, and whether it is the one that was: by its hashes.
struct ReachedState {
    WorldState state;
    bool worldSame = true;     ///< false: this build computes otherwise than the one that recorded
    bool memoriesSame = true;  ///< false: what sensors and controllers remember is of the keyframe before
    std::size_t read = 0;      ///< bytes of its block's decisions that led there, for advance()
};

/// Reaches ticks of a timeline: from the last keyframe before it steps again, first with the controllers, so that their
/// memory comes along, and decisions from outside in their place. If that does not give the recorded hashes (a
/// controller is missing, was changed, or hides memory), it steps with all decisions as recorded and asks no
/// controller, and goes on so for as long as it lives.
class Playback {
public:
    explicit Playback(const Scenario& scenario) : scenario_(scenario) {}

    /// Error: the tick is not in the timeline, or a keyframe is none of this scenario.
    Expected<ReachedState> reach(const Timeline& timeline, std::int64_t tick);

    /// One tick on from a state that this reached, and `trace` of that tick. Error: as of reach(); the state stays.
    Expected<void> advance(const Timeline& timeline, ReachedState& from, StepTrace& trace);

private:
    Expected<ReachedState> reachBy(bool asking, const TimelineBlock& block, std::int64_t tick);

    const Scenario& scenario_;
    StepBuffers buffers_;
    bool askControllers_ = true;
};

}  // namespace mrose
