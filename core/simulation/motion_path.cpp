#include "simulation/motion_path.h"

#include <cmath>

namespace mrose {
namespace {

Twist operator*(double factor, const Twist& t) { return {factor * t.x, factor * t.y, factor * t.rotation}; }
Twist operator+(const Twist& a, const Twist& b) { return {a.x + b.x, a.y + b.y, a.rotation + b.rotation}; }

/// The right Jacobian of SE(2) at p (Sola, Deray, Atchuthan 2018, eq. 163): body velocity = J p'.
struct RightJacobian {
    double along, across;  ///< sin(r)/r, (1 - cos(r))/r
    double fromRotationX, fromRotationY;

    explicit RightJacobian(const Twist& p) {
        const double r = p.rotation;
        double left;  // (r - sin(r)) / r2
        if (std::abs(r) < 1e-3) {
            along = 1 - r * r / 6;
            across = r / 2 * (1 - r * r / 12);
            left = r / 6 * (1 - r * r / 20);
        } else {
            const double sine = std::sin(r), half = std::sin(r / 2);
            along = sine / r;
            across = 2 * half * half / r;
            left = (r - sine) / (r * r);
        }
        const double right = std::abs(r) < 1e-3 ? 0.5 - r * r / 24 : across / r;  // (1 - cos(r)) / r2
        fromRotationX = left * p.x - right * p.y;
        fromRotationY = right * p.x + left * p.y;
    }

    Twist apply(const Twist& rate) const {
        return {along * rate.x + across * rate.y + fromRotationX * rate.rotation,
                along * rate.y - across * rate.x + fromRotationY * rate.rotation, rate.rotation};
    }
    Twist solve(const Twist& velocity) const {
        const double x = velocity.x - fromRotationX * velocity.rotation;
        const double y = velocity.y - fromRotationY * velocity.rotation;
        const double squared = along * along + across * across;
        return {(along * x - across * y) / squared, (along * y + across * x) / squared, velocity.rotation};
    }
};

struct LogPoint {
    Twist value, rate;  ///< p(s), p'(s)
};

/// Hermite's cubic from 0 to the logarithm.
LogPoint logAt(const MotionSegment& segment, double s) {
    const Twist& m0 = segment.startRate;
    const Twist& m1 = segment.endRate;
    const Twist b = 3 * segment.logarithm + -2 * m0 + -1 * m1;
    const Twist c = m0 + m1 + -2 * segment.logarithm;
    return {s * (m0 + s * (b + s * c)), m0 + s * (2 * b + 3 * s * c)};
}

}  // namespace

MotionSegment beginSegment(const Pose& pose, const Twist& velocity_B, const MotionStep& predicted, std::int64_t tick,
                           double period) {
    MotionSegment segment;
    segment.startTick = tick;
    segment.start = pose;
    segment.increment = predicted.increment;
    segment.logarithm = log(predicted.increment);
    segment.startRate = {period * velocity_B.x, 0, period * velocity_B.rotation};
    segment.endRate =
        RightJacobian(segment.logarithm).solve({period * predicted.velocity.v, 0, period * predicted.velocity.w});
    segment.endVelocity = predicted.velocity;
    segment.unperturbed = predicted.unperturbed;
    segment.hasUnperturbed = true;
    return segment;
}

MotionSegment restAt(const Pose& pose, std::int64_t tick) {
    MotionSegment segment;
    segment.startTick = tick;
    segment.start = pose;
    return segment;
}

PathPoint at(const MotionSegment& segment, double share, double period) {
    if (share >= 1) return {segment.start * segment.increment, {segment.endVelocity.v, 0, segment.endVelocity.w}};
    const LogPoint p = logAt(segment, share);
    return {segment.start * exp(p.value), (1 / period) * RightJacobian(p.value).apply(p.rate)};
}

void moveTo(MotionSegment& segment, double share, const Pose& pose) {
    const Pose done = share >= 1 ? segment.increment : exp(logAt(segment, share).value);
    segment.start = pose * inverse(done);
}

}  // namespace mrose
