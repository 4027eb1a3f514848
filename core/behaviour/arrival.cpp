#include "behaviour/arrival.h"

#include <algorithm>
#include <cmath>

#include "geometry/point.h"

namespace mrose {
namespace {

constexpr double alignGain = 2;  // 1/s
constexpr double unsure = 4;     // standard deviations of its belief, before it leaves where it has arrived

}  // namespace

void Arrival::update(const Pose& ahead, const Pose& goal, const OwnBelief& self, const Tolerances& tolerances) {
    const Point line = position(goal) - position(ahead);
    const double off = length(line), turn = std::abs(wrapAngle(goal.heading - ahead.heading));
    const Placement frame(ahead);
    const double onwards = frame.rotateBack(line).x * (tailFirst != 0 ? -1 : 1);
    if (phase == backingOff) phase = approaching;
    if (phase != approaching && off > tolerances.position + unsure * std::sqrt(self.positionVariance))
        phase = approaching;
    if (phase == approaching && (off < tolerances.position / 2 || (off < tolerances.position && onwards < 0)))
        phase = aligning;
    if (phase == aligning && turn < tolerances.heading / 2) phase = resting;
    if (phase == resting && turn > tolerances.heading + unsure * std::sqrt(self.headingVariance)) phase = aligning;
    // Once it goes tail first, it stays so until the target is clearly ahead, and the other way round.
    if (phase == approaching && tolerances.backwards && onwards < -0.2 * off) tailFirst ^= 1;
}

Command turnTo(double heading, const Pose& ahead, double rotation) {
    return {0, std::clamp(alignGain * wrapAngle(heading - ahead.heading), -rotation, rotation)};
}

bool standsStill(const Velocity& velocity) { return std::abs(velocity.v) < 0.05 && std::abs(velocity.w) < 0.1; }

}  // namespace mrose
