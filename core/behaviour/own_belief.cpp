#include "behaviour/own_belief.h"

#include "geometry/point.h"

namespace mrose {
namespace {

// Measurements' deviations: those of a camera, larger for its bias, which successive measurements share.
constexpr double positionDeviation = 0.1, headingDeviation = 0.05;  // m, rad
// What odometry does not measure: of each metre and radian, and, by pushes, of each root of a second.
constexpr double slip = 0.05, drift = 0.01, headingDrift = 0.005;
constexpr double farOff = 4;  // standard deviations
constexpr std::int64_t mostRefused = 3;

double square(double x) { return x * x; }

}  // namespace

void OwnBelief::advance(const MotionMemory& motion) {
    const Nanoseconds since = motion.sinceLast();
    const Pose moved = motion.motionSince(motion.now() - since);
    pose = pose * moved;
    positionVariance += square(slip * length(position(moved))) + square(drift) * toSeconds(since);
    headingVariance += square(slip * moved.heading) + square(headingDrift) * toSeconds(since);
}

void OwnBelief::correct(const Pose& measuredNow) {
    const Point off = position(measuredNow) - position(pose);
    const double turned = wrapAngle(measuredNow.heading - pose.heading);
    const double positionSum = positionVariance + square(positionDeviation);
    const double headingSum = headingVariance + square(headingDeviation);
    if (dot(off, off) > square(farOff) * positionSum || square(turned) > square(farOff) * headingSum) {
        if (++refused <= mostRefused) return;
        pose = measuredNow;
        positionVariance = square(positionDeviation);
        headingVariance = square(headingDeviation);
    } else {
        const double gain = positionVariance / positionSum, headingGain = headingVariance / headingSum;
        pose = {pose.x + gain * off.x, pose.y + gain * off.y, pose.heading + headingGain * turned};
        positionVariance *= 1 - gain;
        headingVariance *= 1 - headingGain;
    }
    refused = 0;
}

void OwnBelief::update(const Observation& observation, const MotionMemory& motion) {
    if (known != 0) advance(motion);
    if (!observation.localised() || (known != 0 && observation.selfMeasured() <= measured)) return;
    const Pose measuredNow = observation.self() * motion.motionSince(observation.selfMeasured());
    measured = observation.selfMeasured();
    if (known != 0) return correct(measuredNow);
    pose = measuredNow;
    positionVariance = square(positionDeviation);
    headingVariance = square(headingDeviation);
    known = 1;
}

}  // namespace mrose
