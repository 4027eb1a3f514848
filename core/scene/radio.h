#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "world/radio_limits.h"
#include "world/time.h"

namespace mrose {

struct Scene;

/// How messages get from robot to robot.
struct Radio {
    static constexpr Nanoseconds mostDelay = nanosecondsPerSecond;  ///< of latency, and of jitter

    Nanoseconds latency =
        0;                   ///< from sending to arrival; they are received at the next control instant at the earliest
    Nanoseconds jitter = 0;  ///< up to so much later, evenly drawn for each message and receiver
    double loss = 0;         ///< probability, of each message and receiver
    double range = 0;        ///< m, from where the sender was to where the receiver is; 0: no end
    std::size_t messageBytes = mostMessageBytes;  ///< limit of the size of one
    bool operator==(const Radio&) const = default;
};

/// The team of each robot; messages reach team mates only. Where no robot names a team all are one; where some do, the
/// others are in none.
std::vector<std::uint32_t> teamsOf(const Scene& scene);
constexpr std::uint32_t noTeam = 0xffffffff;

/// So many ticks after the one in which it was sent a message that takes so long arrives: not in the same one.
constexpr std::int64_t arrivalTicks(Nanoseconds duration, Nanoseconds tickLength) {
    const std::int64_t ticks = (duration + tickLength - 1) / tickLength;
    return ticks > 1 ? ticks : 1;
}

}  // namespace mrose
