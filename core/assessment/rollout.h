#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/tracker_offset.h"
#include "io/error.h"
#include "logs/robot_log.h"
#include "motion/motion_model.h"

namespace mrose {

/// One open-loop prediction to make: where the robot will be at start + k * step, k = 1 ... steps, if it is sent the
/// commands of its trajectory.
struct RolloutStart {
    const Trajectory* trajectory = nullptr;  ///< its commands; its poses are not read
    Nanoseconds time = 0;
    Pose pose;  ///< at `time`
    /// At `time` or before, from when on the model carries it on; unknown: what the model reaches over
    /// RolloutOptions::lead.
    std::optional<StampedVelocity> velocity;
    int steps = 0;
    TrackerEvidence tracked;  ///< from what was seen before `time`; of the model that predicts it (fillTracked)
    std::uint32_t body = 0;   ///< which robot of a world it is, for what is random
    std::optional<std::uint64_t> seed = std::nullopt;  ///< of the run in which noise is drawn; none: the mean is wanted
};

/// Of the run that is one sample of what a robot of a log does from `start` on. Samples have nothing in common with
/// those of other starts, so that what is by chance too wide in one is too narrow in another. It does not depend on
/// which other robots and starts there are.
std::uint32_t sampleSeed(std::uint64_t seed, const std::string& robot, const RolloutStart& start, std::uint32_t sample);

struct RolloutOptions {
    Nanoseconds step = 100'000'000;          ///< of the output; a whole multiple of the model's period
    Nanoseconds lead = commandsKnownBefore;  ///< commands known to the model before the start
    Nanoseconds tick = 20'000'000;           ///< of the run in which noise is drawn
};

/// The commands that a rollout reads up to `until`: the one in force a lead before its start, and all since. A
/// trajectory marked steady is taken to have had its first command before it began.
std::vector<StampedCommand> commandsRead(const RolloutStart& start, Nanoseconds until,
                                         const RolloutOptions& options = {});

/// Makes all velocities those of the starts' time: earlier ones are carried on by the model, to the nearest period;
/// those that are not known are what it reaches from standstill over the lead.
void fillVelocities(const MotionModel& model, std::span<RolloutStart> starts, const RolloutOptions& options = {});

/// Predicted poses, one list per start, `steps` long, in the frame of the start's pose. Starts advance together,
/// in large batches. At each period the command history holds exactly the commands stamped at or before its start:
/// nothing later can be read. Noise is what a world draws that begins at the start. A trajectory marked steady is taken
/// to have had its first command before it began; any other one stood before its first command. Error: the model's
/// period does not divide the step.
Expected<std::vector<std::vector<Pose>>> rollOut(const MotionModel& model, std::span<const RolloutStart> starts,
                                                 const RolloutOptions& options = {});

}  // namespace mrose
