#pragma once

#include <cstdint>

#include "behaviour/motion_memory.h"

namespace mrose {

/// Where a robot believes to be: odometry, drawn towards what it measures of its pose by a Kalman filter whose
/// covariance is a circle and a heading's. Single measurements far off are refused. Part of a controller's memory; all
/// zero it knows nothing.
struct OwnBelief {
    Pose pose;                                 ///< now
    double positionVariance, headingVariance;  ///< m2, rad2
    Nanoseconds measured;                      ///< the newest measurement that was taken in
    std::int64_t known;                        ///< 0 until the first one
    std::int64_t refused;                      ///< measurements in succession

    /// `motion` has observed already.
    void update(const Observation& observation, const MotionMemory& motion);
    Pose at(Nanoseconds time, const MotionMemory& motion) const { return pose * inverse(motion.motionSince(time)); }

private:
    void advance(const MotionMemory& motion);
    void correct(const Pose& measuredNow);
};
static_assert(sizeof(OwnBelief) == 8 * 8, "without padding");

}  // namespace mrose
