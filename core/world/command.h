#pragma once

#include <cmath>

#include "world/time.h"

namespace mrose {

/// What a differential-drive robot is told to do.
struct Command {
    double v = 0;  ///< forward speed, m/s
    double w = 0;  ///< rotation rate, rad/s, counter-clockwise
    bool operator==(const Command&) const = default;
};

/// Equal, and so are the signs of zeros: some drives turn on a rotation rate of -0.
inline bool identical(const Command& a, const Command& b) {
    return a == b && std::signbit(a.v) == std::signbit(b.v) && std::signbit(a.w) == std::signbit(b.w);
}

struct StampedCommand {
    Nanoseconds time = 0;  ///< of issue
    Command command;
    bool operator==(const StampedCommand&) const = default;
};

/// What it does: velocity in the body's frame.
struct Velocity {
    double v = 0;  ///< forward speed, m/s
    double w = 0;  ///< rotation rate, rad/s
    bool operator==(const Velocity&) const = default;
};

}  // namespace mrose
