#pragma once

#include "world/command.h"

namespace mrose {

/// Turns wheel commands into body commands. The defaults are the nominal geometry of a Clearpath Husky.
struct DifferentialDrive {
    double wheelRadius = 0.165;  ///< m
    double track = 0.555;        ///< m, between left and right wheels; a skid-steered robot's fitted value is larger
    bool operator==(const DifferentialDrive&) const = default;

    /// rad/s.
    struct WheelSpeeds {
        double left = 0, right = 0;
        bool operator==(const WheelSpeeds&) const = default;
    };

    /// Wheel speeds in rad/s.
    Command toCommand(double left, double right) const {
        return {wheelRadius * (left + right) / 2, wheelRadius * (right - left) / track};
    }
    WheelSpeeds toWheels(const Command& command) const {
        return {(command.v - command.w * track / 2) / wheelRadius, (command.v + command.w * track / 2) / wheelRadius};
    }
};

}  // namespace mrose
