#pragma once

#include <array>
#include <cstdint>

#include "control/observation.h"
#include "geometry/pose.h"

namespace mrose {

/// What a robot remembers of its motion and its commands: part of a controller's memory. All zero it is empty.
struct MotionMemory {
    struct Instant {
        Nanoseconds time;
        Velocity velocity;  ///< by odometry
        Command command;    ///< issued then
    };
    static constexpr std::int64_t capacity = 12;

    std::array<Instant, capacity> instants;  ///< the newest first
    std::int64_t count;

    /// To be called first and last in each decision.
    void observe(const Observation& observation);
    void issue(const Command& command) { instants[0].command = command; }

    Nanoseconds now() const { return instants[0].time; }
    Nanoseconds sinceLast() const { return count < 2 ? 0 : instants[0].time - instants[1].time; }
    Command commandAt(Nanoseconds time) const;  ///< the oldest known for times before
    /// How the robot moved since `time`, by odometry, in its own frame at `time`.
    Pose motionSince(Nanoseconds time) const;
    /// How it will move until what it is commanded now takes effect, `deadTime` seconds from now, if it does what it
    /// was commanded; in its own frame of now.
    Pose motionDuring(double deadTime) const;
};
static_assert(sizeof(MotionMemory) == 12 * 40 + 8, "without padding");

}  // namespace mrose
