#pragma once

#include <cstdint>
#include <optional>

#include "behaviour/motion_memory.h"

namespace mrose {

/// Notices that the robot hardly moves though it is commanded to, and then drives it the other way for about a second
/// and turns it at random. Part of a controller's memory; all zero nothing was noticed.
struct BackOff {
    struct Options {
        double speed, rotation;  ///< limits, m/s and rad/s
        double deadTime;         ///< s: what the robot does now was commanded so long ago
        double turn;             ///< rad: about how far it turns afterwards
    };

    double hardlyMoving;        ///< s, for how long
    Nanoseconds turnAt, until;  ///< backwards first
    double v, w;
    std::int64_t times;         ///< how often it has backed off
    std::int64_t inSuccession;  ///< and how often again soon after: farther each time

    /// The command that gets it off, or nullopt. `motion` has observed already.
    std::optional<Command> update(const Observation& observation, const MotionMemory& motion, const Options& options);

private:
    void begin(const Observation& observation, const Command& commanded, const Options& options);
};
static_assert(sizeof(BackOff) == 7 * 8, "without padding");

}  // namespace mrose
