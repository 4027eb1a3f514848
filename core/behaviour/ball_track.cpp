#include "behaviour/ball_track.h"

#include <algorithm>

namespace mrose {
namespace {

constexpr double restlessness = 0.3;                          // m2/s3: how uncertain its velocity becomes
constexpr double atFirst = 0.3, kickedSpeed = 2;              // m/s, standard deviations of its velocity
constexpr double kickedFar = 3;                               // standard deviations
constexpr double trackForgetAfter = 6, trackMissAfter = 0.8;  // s
/// Where any camera should see it.
constexpr double trackSureRange = 2.5, trackSureSlope = 0.5;  // m, aside per ahead

double varianceAt(double range) {
    const double deviation = 0.03 + range * (0.03 + 0.02 * range);
    return deviation * deviation;
}

}  // namespace

void BallTrack::predict(double seconds, const BallFloor& floor) {
    const RollingBall later = RollingBall{position, velocity}.after(seconds, floor);
    position = later.position;
    velocity = later.velocity;
    variance += seconds * (2 * covariance + seconds * velocityVariance);
    covariance += seconds * velocityVariance;
    velocityVariance += restlessness * seconds;
}

void BallTrack::takeIn(const Point& place, Nanoseconds measured, double range, const OwnBelief& self) {
    // By where it is believed to be: a range that is measured too short would seem the better one.
    const double noise = varianceAt(known != 0 ? distance(position, mrose::position(self.pose)) : range);
    if (known == 0) {
        position = place;
        velocity = {};
        variance = noise;
        covariance = 0;
        velocityVariance = atFirst * atFirst;
    } else {
        const Point off = place + toSeconds(time - measured) * velocity - position;
        if (dot(off, off) > kickedFar * kickedFar * (variance + noise)) {
            variance += dot(off, off);
            velocityVariance += kickedSpeed * kickedSpeed;
        }
        const double gain = variance / (variance + noise), velocityGain = covariance / (variance + noise);
        position = position + gain * off;
        velocity = velocity + velocityGain * off;
        velocityVariance -= velocityGain * covariance;
        covariance *= 1 - gain;
        variance *= 1 - gain;
    }
    known = 1;
    missing = 0;
    seen = measured;
}

bool BallTrack::isLost(const OwnBelief& self, double since) {
    const Point at = Placement(self.pose).placeBack(position);
    const bool sure = at.x > 0.2 && length(at) < trackSureRange && std::abs(at.y) < trackSureSlope * at.x;
    missing = sure ? missing + since : 0;
    return missing > trackMissAfter || toSeconds(time - seen) > trackForgetAfter;
}

void BallTrack::update(const Observation& observation, const MotionMemory& motion, const OwnBelief& self,
                       const BallFloor& floor) {
    const double since = known != 0 ? toSeconds(observation.time - time) : 0;
    time = observation.time;
    predict(since, floor);
    const bool sighted = !observation.objects().empty() && observation.objects().front().index == 0;
    if (sighted && (known == 0 || observation.objects().front().measured > seen)) {
        const SeenBody& ball = observation.objects().front();
        const Placement then(self.at(ball.measured, motion));
        takeIn(then.place(ball.position_B), ball.measured, length(ball.position_B), self);
    } else if (known != 0 && isLost(self, since)) {
        known = 0;
    }
}

}  // namespace mrose
