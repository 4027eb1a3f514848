#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "control/controller.h"
#include "planning/timed_path.h"

namespace mrose {

/// What a robot tells its team of its way: a message without padding.
struct ComingPath {
    static constexpr std::uint32_t kind = 0x70617468;  ///< of the message
    static constexpr std::size_t most = 11;            ///< points

    float x, y, heading;                    ///< m and rad, where it is
    float targetX, targetY, targetHeading;  ///< where it wants to be
    float speed;                            ///< m/s
    float holdAt, holdFor;                  ///< m along its way from here, s: where it will stop
    std::uint8_t count;                     ///< of the points
    std::uint8_t resting;                   ///< it has arrived
    std::uint8_t method;                    ///< that it drives by; 0: none is chosen
    std::uint8_t unused;
    std::array<std::array<float, 2>, most> points;  ///< m, that it will come through, the last is its goal

    Point place() const { return {x, y}; }
    Pose target() const { return {targetX, targetY, targetHeading}; }
    /// Where it will be, if it turns on the spot at `rotation` rad/s; `sent` seconds from now, below 0.
    TimedPath timed(double sent, double rotation) const;
};
static_assert(sizeof(ComingPath) == 128, "without padding, and no longer than a message may be");

/// nullopt: it is something else.
std::optional<ComingPath> comingPath(const ReceivedMessage& message);

}  // namespace mrose
