#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "world/command.h"

namespace mrose {

/// What a drive makes of commands that ask too much of it. It follows them no faster than its accelerations allow;
/// where what it follows asks a wheel for more than that can, the wheel does what it can. 0: no limit.
struct ActuatorLimits {
    double accelerationV = 0, accelerationW = 0;  ///< m/s2, rad/s2
    double wheelSpeed = 0;                        ///< m/s
    double halfTrack = 0;                         ///< m, where wheels have a limit

    /// s: accelerations are sought by which the largest command is reached from standstill within this; and the most of
    /// longestRamp.
    static constexpr double mostRamp = 2.4;
    /// s, where there are accelerations: for so long before the oldest command that inputs are made from, older ones
    /// are read where nothing is remembered.
    double longestRamp = mostRamp;
    bool ramps() const { return accelerationV > 0 || accelerationW > 0; }

    Command withinWheelSpeed(const Command& command) const {
        const double left = command.v - halfTrack * command.w, right = command.v + halfTrack * command.w;
        if (wheelSpeed == 0 || std::max(std::abs(left), std::abs(right)) <= wheelSpeed) return command;
        const double ofLeft = std::clamp(left, -wheelSpeed, wheelSpeed),
                     ofRight = std::clamp(right, -wheelSpeed, wheelSpeed);
        return {0.5 * (ofLeft + ofRight), 0.5 * (ofRight - ofLeft) / halfTrack};
    }
    bool operator==(const ActuatorLimits&) const = default;
};

/// For people: "0.50 m/s² and 5.2 rad/s², wheels 0.50 m/s, 0.33 m apart"; "" of none.
std::string limitsInWords(const ActuatorLimits& limits);

}  // namespace mrose
