#pragma once

#include <cstdint>

#include "behaviour/own_belief.h"
#include "behaviour/rolling_ball.h"
#include "geometry/point.h"

namespace mrose {

/// Where a robot believes the ball (object 0) to be, in the world's frame: a filter of its place and velocity that
/// trusts near sightings more. Part of a controller's memory; all zero it knows of none.
struct BallBelief {
    Point position, velocity;  ///< now
    double variance;           ///< m2
    Nanoseconds time;          ///< now
    Nanoseconds seen;          ///< when it was measured last
    double missing;            ///< s, for how long it should have been seen and was not
    std::int64_t known;        ///< 0: it has not been seen, or is lost

    /// `motion` and `self` have been updated already.
    void update(const Observation& observation, const MotionMemory& motion, const OwnBelief& self,
                const BallFloor& floor);
    /// As it will be if nothing but floor and walls touches it; its time stays.
    BallBelief after(double seconds, const BallFloor& floor) const;

private:
    void takeIn(const Point& place, Nanoseconds measured, double range);
};
static_assert(sizeof(BallBelief) == 9 * 8, "without padding");

}  // namespace mrose
