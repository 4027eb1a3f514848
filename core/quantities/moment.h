#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "quantities/real_robots.h"
#include "scenario/drawn_values.h"
#include "scenario/scenario.h"
#include "simulation/step.h"

namespace mrose {

/// What a robot saw, decided and was predicted to do at its last control instant: it holds until the next.
struct RobotInsight {
    std::int64_t tick = -1;  ///< of the state in which it decided; -1: never yet
    bool observed = false;
    Observation observation;
    Decision decision;
    MotionStep predicted;
    std::vector<std::byte> memoryBefore;  ///< its controller's, before it decided
    /// What is known of its sensors beside that: what its controller does not read, and what those with clocks of
    /// their own gave last, where that was before this observation.
    Observation others = {};
};

/// Takes over what robots saw and decided in the tick that led to `tick`, whose trace asked for what is unread.
/// `memoryBefore` is WorldState::memory before that.
void noteInsights(const Scenario& scenario, const StepTrace& trace, std::int64_t tick,
                  const std::vector<std::byte>& memoryBefore, std::vector<RobotInsight>& insights);

/// What is known of a run at a tick: all that quantities are read from.
struct Moment {
    const Scenario* scenario = nullptr;
    const WorldState* state = nullptr;
    const StepTrace* trace = nullptr;             ///< of the tick that led there; nullptr at a run's start
    std::span<const RobotInsight> insights = {};  ///< of each robot; empty: they were not recorded
    const RealRobots* real = nullptr;             ///< nullptr: no real log is open
    const DrawnValues* drawn = nullptr;           ///< for a trial of an experiment; nullptr: what the scenario knows
    const DrawnValues* measured = nullptr;        ///< of that trial, at its end

    const Scene& scene() const { return scenario->scene(); }
    /// nullptr: it is of no trial.
    const DrawnValues* drawnValues() const { return drawn != nullptr ? drawn : scenario->parts().drawn.get(); }
    Nanoseconds now() const { return scene().timeOf(state->tick); }
};

/// A reading that is known of a robot's sensor; valid as long as `of`.
struct NewestReading {
    const Sensor* sensor = nullptr;
    const Observation* of = nullptr;
    const Reading* reading = nullptr;

    template <class T>
    std::span<const T> records() const {
        return of->records<T>(reading);
    }
};
/// The newest of each that a robot's sensors have given, in their order; of sensors with clocks of their own as long as
/// no other is missing (knownFor).
std::vector<NewestReading> newestReadings(const Moment& moment, std::size_t robot);
/// How long after its measurement a reading is known, if no other one comes: a period and a half. Of slow sensors less,
/// so that going to a tick stays quick.
Nanoseconds knownFor(const Scenario& scenario, std::size_t robot, const Sensor& sensor);

}  // namespace mrose
