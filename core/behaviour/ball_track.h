#pragma once

#include <cstdint>

#include "behaviour/own_belief.h"
#include "behaviour/rolling_ball.h"
#include "geometry/point.h"

namespace mrose {

/// Where a robot has seen the ball (object 0), in the world's frame, and how it rolls: a Kalman filter of place and
/// velocity, of the same variances in all directions. Other than BallBelief it knows how sure it is of the velocity, so
/// that far balls do not seem to roll, and does not take near measurements of a far ball for better ones: what it says
/// is fit to be told others. A ball that is suddenly elsewhere was kicked. Part of a controller's memory; all zero it
/// knows of none.
struct BallTrack {
    Point position, velocity;                       ///< now
    double variance, covariance, velocityVariance;  ///< m2, m2/s, m2/s2
    Nanoseconds time;                               ///< now
    Nanoseconds seen;                               ///< when it was measured last
    double missing;                                 ///< s, for how long it should have been seen and was not
    std::int64_t known;                             ///< 0: it has not been seen, or is lost

    /// `motion` and `self` have been updated already.
    void update(const Observation& observation, const MotionMemory& motion, const OwnBelief& self,
                const BallFloor& floor);

private:
    void predict(double seconds, const BallFloor& floor);
    void takeIn(const Point& place, Nanoseconds measured, double range, const OwnBelief& self);
    bool isLost(const OwnBelief& self, double since);
};
static_assert(sizeof(BallTrack) == 11 * 8, "without padding");

}  // namespace mrose
