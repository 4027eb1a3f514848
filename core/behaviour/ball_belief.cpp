#include "behaviour/ball_belief.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

constexpr double rollingDeceleration = 0.4;         // m/s2
constexpr double fastest = 5;                       // m/s
constexpr double unrest = 0.05;                     // m2/s: how uncertain its place becomes
constexpr double forgetAfter = 6, missAfter = 0.8;  // s
/// Where any camera should see it.
constexpr double sureRange = 2.5, sureSlope = 0.5;  // m, aside per ahead

double deviationAt(double range) { return 0.03 + range * (0.03 + 0.02 * range); }

}  // namespace

void BallBelief::roll(double seconds) {
    const double speed = length(velocity);
    if (speed == 0) return;
    const double duration = std::min(seconds, speed / rollingDeceleration);
    position = position + (duration - rollingDeceleration * duration * duration / (2 * speed)) * velocity;
    velocity = (1 - rollingDeceleration * duration / speed) * velocity;
}

BallBelief BallBelief::after(double seconds) const {
    BallBelief later = *this;
    later.roll(seconds);
    later.variance += unrest * seconds;
    return later;
}

void BallBelief::takeIn(const Point& place, Nanoseconds measured, double range) {
    const double deviation = deviationAt(range);
    if (known == 0) {
        position = place;
        velocity = {};
        variance = deviation * deviation;
    } else {
        const Point off = place - (position - toSeconds(time - measured) * velocity);
        const double gain = variance / (variance + deviation * deviation);
        const double since = std::max(0.05, toSeconds(measured - seen));
        position = position + gain * off;
        velocity = velocity + (gain * gain / (2 - gain) / since) * off;
        const double speed = length(velocity);
        if (speed > fastest) velocity = (fastest / speed) * velocity;
        variance *= 1 - gain;
    }
    known = 1;
    missing = 0;
    seen = measured;
}

void BallBelief::update(const Observation& observation, const MotionMemory& motion, const OwnBelief& self) {
    const double since = known != 0 ? toSeconds(observation.time - time) : 0;
    time = observation.time;
    roll(since);
    variance += unrest * since;
    const bool sighted = !observation.objects().empty() && observation.objects().front().index == 0;
    if (sighted && (known == 0 || observation.objects().front().measured > seen)) {
        const SeenBody& ball = observation.objects().front();
        const Placement then(self.at(ball.measured, motion));
        takeIn(then.place(ball.position_B), ball.measured, length(ball.position_B));
    } else if (known != 0) {
        const Point at = Placement(self.pose).placeBack(position);
        const bool sure = at.x > 0.2 && length(at) < sureRange && std::abs(at.y) < sureSlope * at.x;
        missing = sure ? missing + since : 0;
        if (missing > missAfter || toSeconds(time - seen) > forgetAfter) known = 0;
    }
}

}  // namespace mrose
