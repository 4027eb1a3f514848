#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/assess.h"
#include "assessment/log_world.h"
#include "assessment/rollout_requests.h"
#include "assessment/stream_comparison.h"

namespace mrose {

/// What becomes of a rollout in the figures.
enum class RolloutUse {
    counted,  ///< a window as the referee has them: its errors are in P and Hd
    still,    ///< the robot hardly moves: too little to divide an error by
    gap,      ///< the ground truth has a gap in it: errors are known at the other instants only
    absent    ///< no ground truth at the start: the robot is not in the world
};
constexpr int rolloutUses = 4;
const char* name(RolloutUse use);

/// One robot in one rollout, real and simulated on the same clock.
struct ComparedRollout {
    std::size_t request = 0;  ///< which rollout: in Comparison::requests
    std::size_t robot = 0;    ///< in Comparison::robots
    RolloutUse use = RolloutUse::counted;
    /// Truth at the steps() + 1 instants, not a number where it is not known; what was measured at the start.
    Window real;
    TrackerEvidence tracked = {};                       ///< from what was seen before the start, of the robot's model
    std::vector<std::size_t> jumps = {};                ///< steps, 1 ..., whose truth knows of a jump, ascending
    std::vector<Pose> simulated;                        ///< after each step: steps() poses; none of an absent robot
    WindowErrors errors;                                ///< not a number where the truth is not known
    std::int64_t touches = 0;                           ///< how often it began to touch something in the simulation
    std::optional<Nanoseconds> touched = std::nullopt;  ///< since the start, when contact first took it off its way
};

/// The rollouts of one robot, or of all.
struct ComparedSummary {
    Summary counted;                              ///< P, Hd and errors of the rollouts that count
    std::array<std::size_t, rolloutUses> uses{};  ///< rollouts by RolloutUse
    Distribution positionFinal, headingFinal;     ///< m, rad: of all rollouts whose end is known
    std::int64_t touches = 0;
    std::size_t touched = 0;  ///< rollouts in which contact took the robot off its way

    std::size_t of(RolloutUse use) const { return uses[static_cast<std::size_t>(use)]; }
    std::size_t rollouts() const { return uses[0] + uses[1] + uses[2] + uses[3]; }
};

struct ComparisonOptions {
    std::uint64_t seed = 1;
    bool readings = false;    ///< what sensors report is compared too
    WindowOptions windows{};  ///< `step` and what is too little motion; rollouts have their own lengths
    /// Called in the caller's thread, part by part, with the rollouts that are done and the share of them. False: it is
    /// to end. Empty: progress is not reported.
    std::function<bool(std::span<const ComparedRollout> part, double share)> progress = {};
};

/// A simulated world beside the log that it repeats. It holds no reference to either.
struct Comparison {
    std::string scenario;
    std::uint64_t seed = 0;
    std::vector<ComparedRobot> robots;
    std::vector<std::string> sessions;  ///< their names
    std::vector<RolloutRequest> requests;
    std::vector<ComparedRollout> rollouts;   ///< by request, then by robot
    std::vector<ComparedSummary> summaries;  ///< by robot
    ComparedSummary all;
    LogWindows log;                       ///< the rollouts that count, as windows of the log
    Assessment simulation;                ///< of these
    std::vector<std::size_t> counted;     ///< log.windows[i] is of rollouts[counted[i]]
    std::vector<std::string> subjects;    ///< of the log, by name
    std::vector<ComparedSensor> sensors;  ///< where readings were asked for: what log and robots have both
    std::int64_t touches = 0;             ///< pairs of bodies that began to touch, those that are not compared too
    std::int64_t faults = 0;              ///< of controllers and models
    std::string firstFault;
};

/// Drives every rollout in a world of its own and compares. The result is the same for any number of threads. Error:
/// the scenario's ticks do not divide the step; no rollout has any ground truth at its start; `progress` ended it.
Expected<Comparison> compare(const LogWorld& world, std::span<const RolloutRequest> requests,
                             const ComparisonOptions& options = {});

/// m, the mean position error over the instants that are known; below zero where none is.
double knownMean(const ComparedRollout& rollout);
/// Indices of the rollouts that were simulated, by descending knownMean().
std::vector<std::size_t> worstFirst(const Comparison& comparison);

}  // namespace mrose
