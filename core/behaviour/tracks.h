#pragma once

#include <array>
#include <cstdint>

#include "geometry/point.h"
#include "world/time.h"

namespace mrose {

/// Small things that a robot has seen several times, and how they move: places and velocities by alpha-beta filters.
/// Part of a controller's memory; all zero there are none.
struct Tracks {
    struct Track {
        Point place;     ///< m, in a frame that stands still
        Point velocity;  ///< m/s
        Nanoseconds seen;
    };
    static constexpr std::size_t most = 8;

    std::array<Track, most> tracks;
    std::uint64_t count;

    /// Before the things of one instant: what was not seen for long is forgotten.
    void begin(Nanoseconds now);
    /// Takes in a thing that was seen: as the track that leads nearest to there, or as a new one. Its velocity; nothing
    /// of what hardly moves.
    Point take(const Point& place, Nanoseconds seen);
};
static_assert(sizeof(Tracks) == 8 * 40 + 8, "without padding");

}  // namespace mrose
