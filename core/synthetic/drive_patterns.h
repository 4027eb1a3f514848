#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "logs/robot_log.h"

namespace mrose {

/// What a synthetic log drives: the random driving that is learned from, and the two paths of Buck, Beetz and Schmitt
/// (2002) that show it.
enum class DrivePattern {
    random,      ///< straight and in curves, on the spot, stops, ramps, reversals; held for 0.2 to 3 s
    hardSwitch,  ///< random driving; between 7.5 and 11 s from full speed to zero in one command
    jink,        ///< straight, round an obstacle on its left, straight on
    ellipse,     ///< once round, back to where it began
};
constexpr int patternCount = 4;
std::string_view name(DrivePattern pattern);  ///< "random", "hard_switch", "jink", "ellipse": as its file is called

/// m, m/s: the shapes of the two paths, as ideal kinematics would drive them.
struct PatternShape {
    double speed = 0.3, acceleration = 0.3;
    double ellipseLong = 1.2, ellipseShort = 0.8;  ///< semi-axes; it begins at the end of the short one
    double jinkStraight = 0.8;                     ///< before and behind
    double jinkLength = 1.0, jinkSide = 0.35;      ///< of each of the two swerves, along its path, and to the side
};

/// Commands at 10 Hz, at a random phase, over `duration` s from 0, with a jitter of some milliseconds; the same seed
/// and index, the same commands. `duration` below 0: as long as the pattern takes, with 2 s of standing at its end; 60
/// s for random driving.
std::vector<StampedCommand> patternCommands(DrivePattern pattern, double duration, std::uint64_t seed,
                                            std::uint32_t index, const PatternShape& shape = {});

/// As patternCommands takes it where it is below 0.
double patternDuration(DrivePattern pattern, const PatternShape& shape = {});

}  // namespace mrose
