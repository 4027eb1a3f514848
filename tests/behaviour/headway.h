#pragma once

#include <algorithm>
#include <vector>

#include "geometry/point.h"
#include "world/world_state.h"

namespace mrose {

/// Watches how far a robot gets within a stretch of time.
class Headway {
public:
    explicit Headway(std::size_t ticks) : ticks_(ticks) {}

    void watch(const Pose& pose) {
        poses_.push_back(pose);
        if (poses_.size() < ticks_) return;
        double far = 0, turned = 0;
        for (std::size_t i = poses_.size() - ticks_; i < poses_.size(); ++i) {
            far = std::max(far, distance(position(poses_[i]), position(pose)));
            turned = std::max(turned, std::abs(poses_[i].heading - pose.heading));
        }
        leastWay_ = std::min(leastWay_, far);
        leastMotion_ = std::min(leastMotion_, far + 0.2 * turned);
    }
    double leastWay() const { return leastWay_; }        ///< m
    double leastMotion() const { return leastMotion_; }  ///< m, turning on the spot counted as well

private:
    std::size_t ticks_;
    std::vector<Pose> poses_;
    double leastWay_ = 1e9, leastMotion_ = 1e9;
};

}  // namespace mrose
