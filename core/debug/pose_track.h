#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "debug/trails.h"
#include "world/world_state.h"

namespace mrose {

/// Where all bodies of a branch were at each tick, to draw trails and ghosts from: 12 bytes a body and tick. The
/// earliest can be forgotten.
class PoseTrack {
public:
    explicit PoseTrack(const WorldState& start) : first_(start.tick) { add(start); }

    void add(const WorldState& state);
    std::size_t bytes() const { return blocks_.size() * blocks_.back()->bytes(); }
    /// The earliest block; false: there is but one.
    bool forgetEarliest();
    std::int64_t first() const { return first_; }
    std::int64_t last() const { return first_ + ticks_ - 1; }

    /// Appends the ways up to and with `tick`, of at most `ticks` before it.
    void addTrails(std::int64_t tick, std::size_t ticks, Trails& trails) const;
    /// Of all bodies at a tick between first() and last().
    std::vector<Pose> posesAt(std::int64_t tick) const;

private:
    std::deque<std::shared_ptr<TrailBlock>> blocks_;  ///< all full but the last
    std::int64_t first_ = 0, ticks_ = 0;
};

}  // namespace mrose
