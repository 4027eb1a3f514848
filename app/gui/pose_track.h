#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "geometry/point.h"
#include "world/world_state.h"

namespace mrose::gui {

/// Where all bodies of a branch were at each tick, to draw trails and ghosts from. Of long runs with many bodies the
/// earliest are forgotten.
class PoseTrack {
public:
    explicit PoseTrack(const WorldState& start) { add(start); }

    void add(const WorldState& state);
    std::int64_t first() const { return first_; }
    std::int64_t last() const { return first_ + static_cast<std::int64_t>(rows_.size()) - 1; }

    /// Of each body, up to and with `tick`, at most `ticks` before it, oldest first.
    std::vector<std::vector<Point>> trails(std::int64_t tick, std::size_t ticks) const;
    /// Of all bodies at a tick between first() and last().
    std::vector<Pose> posesAt(std::int64_t tick) const;

private:
    static constexpr std::size_t mostBytes = std::size_t{64} << 20;
    struct Place {
        float x, y, heading;
    };
    using Row = std::vector<Place>;

    std::deque<Row> rows_;
    std::int64_t first_ = 0;
};

}  // namespace mrose::gui
