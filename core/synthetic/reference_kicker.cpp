#include "synthetic/reference_kicker.h"

#include <algorithm>
#include <cmath>

#include "synthetic/sensor_noise.h"

namespace mrose {
namespace {

enum KickerChannel : std::uint32_t { pollPhase = 400, lateness, reachesEnd, strength, rolling };

}  // namespace

double ReferenceKicker::delay(double power, std::int64_t kick) const {
    const double phase = p_.poll * uniformNoise({seed_, kick, 0, pollPhase});
    const double tail = -p_.deadTimeTail * logarithm(uniformNoise({seed_, kick, 0, lateness}));
    return p_.deadTime + p_.slowStart * (1 - power) + phase + tail;
}

ReferenceDeparture ReferenceKicker::strike(double power, const Point& ball_B, const Velocity& robot,
                                           std::int64_t kick) const {
    const double gap = ball_B.x - p_.face - p_.ballRadius, side = ball_B.y;
    const NoisePair ends = boxMullerPair({seed_, kick, 0, reachesEnd});
    ReferenceDeparture departure;
    departure.hit = gap < p_.reach + p_.edge * ends.first && std::abs(side) < p_.halfWidth + p_.edge * ends.second;
    if (!departure.hit) return departure;
    const double off = side / p_.halfWidth;
    const NoisePair noise = boxMullerPair({seed_, kick, 0, strength});
    const double charge = 1 - p_.droop * std::fmod(static_cast<double>(kick), p_.kicksOfBattery) / p_.kicksOfBattery;
    const double along = power > 0 ? exponential(p_.powerExponent * logarithm(power)) : 0;
    const double uneven = 1 - p_.hollow * off * off + p_.ripple * sine(42 * side);
    const double speed = p_.speed * along * charge * uneven * (1 - p_.perGap * gap) *
                         (1 + p_.speedNoise * (1 + off * off) * noise.first);
    const double direction = p_.crown * side + p_.skew + p_.bend * sine(35 * side + 0.4) +
                             (p_.directionNoise + p_.noiseAtEdge * off * off) * noise.second;
    departure.velocity = std::max(0.0, speed) * towards(direction);
    // The face moves with the robot; across it only friction takes the ball along.
    departure.velocity.x += robot.v - robot.w * side;
    departure.velocity.y += p_.grip * robot.w * (p_.face + gap);
    departure.roll = p_.leastRoll + (p_.mostRoll - p_.leastRoll) * uniformNoise({seed_, kick, 0, rolling});
    departure.spin = p_.spin * length(departure.velocity) * side;
    return departure;
}

}  // namespace mrose
