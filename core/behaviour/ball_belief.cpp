#include "behaviour/ball_belief.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

constexpr double fastest = 5;                       // m/s
constexpr double unrest = 0.05;                     // m2/s: how uncertain its place becomes
constexpr double forgetAfter = 6, missAfter = 0.8;  // s
/// Where any camera should see it.
constexpr double sureRange = 2.5, sureSlope = 0.5;  // m, aside per ahead

double deviationAt(double range) { return 0.03 + range * (0.03 + 0.02 * range); }

}  // namespace

BallBelief BallBelief::after(double seconds, const BallFloor& floor) const {
    BallBelief later = *this;
    const RollingBall rolled = RollingBall{position, velocity}.after(seconds, floor);
    later.position = rolled.position;
    later.velocity = rolled.velocity;
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

void BallBelief::update(const Observation& observation, const MotionMemory& motion, const OwnBelief& self,
                        const BallFloor& floor) {
    const double since = known != 0 ? toSeconds(observation.time - time) : 0;
    time = observation.time;
    *this = after(since, floor);
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
