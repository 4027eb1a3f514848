#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/progress.h"
#include "logs/robot_log.h"
#include "synthetic/drive_patterns.h"
#include "synthetic/reference_robot.h"

namespace mrose {

/// The camera that looks on: stamped poses of a marker, in steps of 0.1 mm and 0.1 mrad.
struct SyntheticTracker {
    Nanoseconds period = 24'000'000;                       ///< a whole multiple of ReferenceRobot::step
    double positionNoise = 0.0005, headingNoise = 0.0015;  ///< m, rad, standard deviations, each sample its own
};

/// One run of the reference robot.
struct SyntheticRun {
    std::vector<StampedPose> tracked;
    std::vector<StampedPose> truth;  ///< at the same instants: what no log holds
};

/// Drives the robot from rest at `start` for `duration` s by commands whose times count from 0. `seed` is that of all
/// that differs between repeated runs.
SyntheticRun runReferenceRobot(std::span<const StampedCommand> commands, double duration, const Pose& start,
                               std::uint64_t seed, const SyntheticTracker& tracker = {});

/// Whether a log has a tracked ball (ball_play.h): one that the robot kicks, or that somebody throws.
enum class BallPlay { none, kicks, throws };

/// Trajectories of one drive pattern: one file.
struct SyntheticPart {
    DrivePattern pattern = DrivePattern::random;
    int trajectories = 1;            ///< different ones (of the jink and the ellipse: with other jitter only)
    double duration = -1;            ///< s each; below 0: patternDuration
    int repeats = 1;                 ///< of each one's commands; the repetitions are one group
    bool sensors = false;            ///< with what the robot's localisation and camera report
    BallPlay ball = BallPlay::none;  ///< in the pattern's place
};
/// "random", "kicks": as its file is called.
std::string_view name(const SyntheticPart& part);
/// s, of each of its trajectories.
double durationOf(const SyntheticPart& part);

/// A set of logs under its name.
struct SyntheticSet {
    std::string_view name, purpose;
    std::vector<SyntheticPart> parts;
};

/// The sets that mrose generate offers: training, held-out, example, repeat, kicks, more-kicks.
const std::vector<SyntheticSet>& syntheticSets();

/// The log of one part, of a robot called "reference": Log::synthetic is set. Trajectories follow each other in time,
/// each from rest. Nothing when it was stopped.
std::optional<Log> generateLog(const SyntheticPart& part, std::uint64_t seed, const Progress& progress = {});

}  // namespace mrose
