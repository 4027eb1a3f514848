#pragma once

#include <span>
#include <string_view>

#include "logs/robot_log.h"

namespace mrose {

/// What the commands of a window ask for. Derived from the commands alone, sampled every 20 ms from 0.5 s before the
/// window to its end:
/// - hardSwitch: at some instant v or w goes within 0.1 s from full to zero or from one sign to the other, with
///   0.3 s of each at least. Full is at least 0.7 of the channel's largest command in the robot's log, zero at most
///   0.1 of it; a change of sign counts from 0.25 of it on both sides;
/// - otherwise turning: the commanded rotation, summed without sign, is at least 0.5 rad per 10 s;
/// - otherwise straight.
enum class Manoeuvre { straight, turning, hardSwitch };
constexpr int manoeuvreCount = 3;
std::string_view name(Manoeuvre manoeuvre);  ///< "straight", "turning", "hard switch"

/// The largest |v| and |w| commanded.
struct CommandScale {
    double v = 0, w = 0;
};
CommandScale commandScale(const RobotLog& robot);

Manoeuvre classify(const Trajectory& trajectory, Nanoseconds start, Nanoseconds end, const CommandScale& scale);

}  // namespace mrose
