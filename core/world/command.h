#pragma once

#include <bit>
#include <cstdint>

#include "world/time.h"

namespace mrose {

/// The command of a differential-drive robot.
struct Command {
    double v = 0;  ///< forward speed, m/s
    double w = 0;  ///< rotation rate, rad/s, counter-clockwise
    bool operator==(const Command&) const = default;
};

/// The same bits. So are the signs of zeros: some drives turn on a rotation rate of -0.
inline bool identical(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }
inline bool identical(const Command& a, const Command& b) { return identical(a.v, b.v) && identical(a.w, b.w); }

struct StampedCommand {
    Nanoseconds time = 0;  ///< of issue
    Command command;
    bool operator==(const StampedCommand&) const = default;
};
inline bool identical(const StampedCommand& a, const StampedCommand& b) {
    return a.time == b.time && identical(a.command, b.command);
}

/// What it does: velocity in the body's frame.
struct Velocity {
    double v = 0;  ///< forward speed, m/s
    double w = 0;  ///< rotation rate, rad/s
    bool operator==(const Velocity&) const = default;
};

}  // namespace mrose
