#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "quantities/real_robots.h"
#include "scenario/scenario.h"
#include "simulation/step.h"

namespace mrose {

/// A reading of bodies out of an observation.
struct SeenBodies {
    ReadingName reading;  ///< "camera.robots"
    Nanoseconds measured = 0;
    std::vector<SeenBody> bodies;
};

/// What a robot saw, decided and was predicted to do at its last control instant: it holds until the next.
struct RobotInsight {
    std::int64_t tick = -1;  ///< of the state in which it decided; -1: never yet
    bool observed = false;
    Observation observation;
    Decision decision;
    MotionStep predicted;
    std::vector<std::byte> memoryBefore;  ///< its controller's, before it decided
    /// What sensors with clocks of their own reported last, where that was in an observation before this one.
    std::vector<SeenBodies> seenBefore = {};
};

/// The same where it lies.
struct SeenBodiesView {
    ReadingName reading;
    Nanoseconds measured = 0;
    std::span<const SeenBody> bodies;
};
/// The newest readings of bodies that a robot has been given, in the order of its sensors; valid as long as `insight`.
std::vector<SeenBodiesView> newestSeen(const Scenario& scenario, std::size_t robot, const RobotInsight& insight);

/// Takes over what robots saw and decided in the tick that led to `tick`. `memoryBefore` is WorldState::memory before
/// that.
void noteInsights(const Scenario& scenario, const StepTrace& trace, std::int64_t tick,
                  const std::vector<std::byte>& memoryBefore, std::vector<RobotInsight>& insights);

/// What is known of a run at a tick: all that quantities are read from.
struct Moment {
    const Scenario* scenario = nullptr;
    const WorldState* state = nullptr;
    const StepTrace* trace = nullptr;             ///< of the tick that led there; nullptr at a run's start
    std::span<const RobotInsight> insights = {};  ///< of each robot; empty: they were not recorded
    const RealRobots* real = nullptr;             ///< nullptr: no real log is open

    const Scene& scene() const { return scenario->scene(); }
    Nanoseconds now() const { return scene().timeOf(state->tick); }
};

}  // namespace mrose
