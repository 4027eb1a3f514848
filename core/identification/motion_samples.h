#pragma once

#include <span>
#include <string>
#include <vector>

#include "learning/hold_out.h"
#include "logs/robot_log.h"
#include "motion/input_reader.h"

namespace mrose {

/// One control period of a real robot: what it did.
struct MotionSample {
    Nanoseconds start = 0;
    Pose increment;          ///< over the period, in the robot's frame at its start
    Velocity before, after;  ///< at the period's start and end
    /// What measuredStart says of the start, the pose in the frame of the truth; if it is asked for.
    Pose measured;
    StampedVelocity measuredVelocity;
};

/// Consecutive periods without a gap, of one robot.
struct SampleRun {
    std::size_t first = 0, count = 0;  ///< in MotionSamples::samples
    int robot = 0;                     ///< index in MotionSamples::robots
    int fold = 0;                      ///< the part of the logs that it belongs to; parts are held out in turn
    int phase = 0;                     ///< the same stretch of the log is read at several phases of the period

    /// Its first patterns whose histories reach into another fold: of a trajectory that continues another one.
    struct Reach {
        int fold = 0;
        std::size_t patterns = 0;
    };
    std::vector<Reach> reaches = {};

    /// The first pattern that is learned from while a fold is held out; `count` if none is.
    std::size_t firstLearned(int heldOut) const;
};

struct SampleOptions {
    Nanoseconds period = 100'000'000;
    int phases = 5;  ///< of the period at which a log is read; more patterns from the same log
    int folds = 4;
    HoldOut heldOut{};  ///< groups that are not among the logs: the others are divided evenly
    double block = 44;  ///< s: a trajectory of several blocks is divided among the folds by blocks, a shorter one
                        ///< belongs to one fold with all of its group
    bool measuredStarts = false;  ///< MotionSample::measured, measuredVelocity
};

/// The patterns of one or several logs.
struct MotionSamples {
    Nanoseconds period = 0;
    int folds = 1, phases = 1;
    std::vector<std::string> robots;
    std::vector<MotionSample> samples;
    std::vector<SampleRun> runs;
    std::size_t width = 0;       ///< inputs per sample
    std::vector<double> inputs;  ///< samples x width, not standardised

    std::span<const double> inputsOf(std::size_t sample) const { return {&inputs[sample * width], width}; }
};

/// Finds how each robot's tracked point lies to its body (least squares of the sideways motion), and turns the samples'
/// increments into those of the body. One offset for each of MotionSamples::robots.
std::vector<TrackerOffset> removeTrackerOffsets(MotionSamples& samples);

/// Reads the patterns of `logs`, with the inputs that `network` names (its standardisation is not used). What is
/// learned from never reads what is held out: at the beginning of each block as much is left out as a pattern reads
/// back, and a period (1 s at least); where a trajectory's commands begin while another one of its robot was tracked,
/// the patterns that read them are marked (SampleRun::reaches). No pattern reads back beyond the first command. Of
/// trajectories of less than 10 s nothing else is given away: patterns go up to the end, and begin as long after the
/// first command as a pattern reads back, 1.5 s at least, or with the truth. Velocities are what the robot measured
/// itself, as in measuredStart, where it did; else slopes of the truth. Error: no pattern at all.
Expected<MotionSamples> motionSamples(std::span<const Log> logs, const MotionNetwork& network,
                                      const SampleOptions& options);

}  // namespace mrose
