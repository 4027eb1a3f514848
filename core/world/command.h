#pragma once

namespace mrose {

/// What a differential-drive robot is told to do.
struct Command {
    double v = 0;  ///< forward speed, m/s
    double w = 0;  ///< rotation rate, rad/s, counter-clockwise
    bool operator==(const Command&) const = default;
};

/// What it does: velocity in the body's frame.
struct Velocity {
    double v = 0;  ///< forward speed, m/s
    double w = 0;  ///< rotation rate, rad/s
    bool operator==(const Velocity&) const = default;
};

}  // namespace mrose
