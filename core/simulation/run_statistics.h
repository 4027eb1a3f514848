#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenario/scenario.h"
#include "simulation/step.h"
#include "simulation/touch_counter.h"

namespace mrose {

/// What happened in a run, in numbers.
struct RunStatistics {
    /// Below this speed a ball lies still, m/s: rolling on, it would hardly come a millimetre far.
    static constexpr double still = 0.01;

    std::int64_t ticks = 0;
    std::vector<std::int32_t> goals;   ///< in each of the environment's goals
    std::int64_t touches = 0;          ///< pairs that began to touch, see TouchCounter
    std::int64_t kicks = 0, hits = 0;  ///< of manipulators; those that met a ball
    std::int64_t faults = 0;           ///< of controllers and models
    std::string firstFault;            ///< "robot 2 (keeper): its controller ..."; empty: none
    std::vector<double> driven;        ///< by each robot, m
    /// How long each robot's driving was unfamiliar to its network when it was decided (FamiliarDriving::bound);
    /// nullopt of one whose motion model cannot say so, and where it is not counted.
    std::vector<std::optional<std::int64_t>> unfamiliar;  ///< ticks
    std::int64_t anyUnfamiliar = 0;                       ///< ticks in which that was so of some robot
    /// How long what each robot's controller last asked lay beyond what was learned (`beyondLearned`); nullopt of one
    /// that does not say so, and where it is not counted.
    std::vector<std::optional<std::int64_t>> beyond;  ///< ticks
    Nanoseconds ballStill = 0;  ///< how long the first ball lay still: of ticks at whose end it did

    /// Of a run that begins at `start`.
    RunStatistics(const Scenario& scenario, const WorldState& start, bool countsUnfamiliar = true,
                  bool countsBeyond = false);
    /// One tick: the state after it, and its trace.
    void add(const WorldState& after, const StepTrace& trace);

    /// Unfamiliar or beyond what was learned for more of the run than this is worth a note.
    static constexpr double notableShare = 0.05;
    /// Of the ticks, from 0 to 1; 0 of no ticks.
    double shareOf(std::int64_t some) const { return ticks > 0 ? double(some) / double(ticks) : 0; }

private:
    void addUnfamiliar(const WorldState& after, const StepTrace& trace);
    void addBeyond(const WorldState& after, const StepTrace& trace);

    const Scenario* scenario_;
    TouchCounter touchCounter_;
    std::vector<Point> places_;                  ///< of the robots, before the next tick
    std::vector<bool> isUnfamiliar_, isBeyond_;  ///< what each robot last decided
    std::size_t ball_ = 0;                       ///< among the objects; behind the last: there is none
};

/// "robot 2 (keeper)": counted from 1, people after the robots under a word of their own.
std::string bodyName(const Scene& scene, std::size_t body);

}  // namespace mrose
