#pragma once

#include "world/command.h"

namespace mrose {

/// Turns wheel commands into body commands. The defaults are the nominal geometry of a Clearpath Husky.
struct DifferentialDrive {
    double wheelRadius = 0.165;  ///< m
    double track = 0.555;        ///< m, between left and right wheels; a skid-steered robot's fitted value is larger
    bool operator==(const DifferentialDrive&) const = default;

    /// Wheel speeds in rad/s.
    Command toCommand(double left, double right) const {
        return {wheelRadius * (left + right) / 2, wheelRadius * (right - left) / track};
    }
};

}  // namespace mrose
