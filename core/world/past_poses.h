#pragma once

#include <cassert>
#include <span>

#include "world/world_state.h"

namespace mrose {

inline const Pose& poseOf(const WorldState& state, std::size_t body) {
    return body < state.robots.size() ? state.robots[body].pose : state.objects[body - state.robots.size()].pose;
}

/// Where bodies were in the last ticks: how WorldState::past is read.
class PastPoses {
public:
    PastPoses() = default;
    PastPoses(std::int64_t depth, std::size_t bodies) : depth_(depth), bodies_(bodies) {}

    /// How many ticks of poses are kept; 0 where no sensor is late.
    std::int64_t depth() const { return depth_; }
    /// Where a body was `lag` ticks ago, 0 <= lag <= depth; before the start it stood where it started.
    const Pose& poseBefore(const WorldState& state, std::size_t body, std::int64_t lag) const {
        return lag == 0 ? poseOf(state, body) : posesBefore(state, lag)[body];
    }
    /// `earlier` of a tick before that, 0 <= earlier < 1: evenly from the one tick's to the other's.
    Pose poseBetween(const WorldState& state, std::size_t body, std::int64_t lag, double earlier) const {
        const Pose& after = poseBefore(state, body, lag);
        if (earlier == 0) return after;
        const Pose& before = poseBefore(state, body, lag + 1);
        return {after.x + earlier * (before.x - after.x), after.y + earlier * (before.y - after.y),
                after.heading + earlier * (before.heading - after.heading)};
    }
    /// Of all bodies, 0 < lag <= depth.
    std::span<const Pose> posesBefore(const WorldState& state, std::int64_t lag) const {
        assert(lag > 0 && lag <= depth_);
        return std::span(state.past).subspan(slot(state.tick - lag) * bodies_, bodies_);
    }
    /// Where those of the state's own tick are kept for later.
    std::span<Pose> posesOfNow(WorldState& state) const {
        return std::span(state.past).subspan(slot(state.tick) * bodies_, bodies_);
    }

private:
    // Slot k of the ring holds the poses of the newest tick that is k modulo the depth; ticks before 0 stand for the
    // start.
    std::size_t slot(std::int64_t tick) const { return static_cast<std::size_t>((tick % depth_ + depth_) % depth_); }

    std::int64_t depth_ = 0;
    std::size_t bodies_ = 0;
};

}  // namespace mrose
