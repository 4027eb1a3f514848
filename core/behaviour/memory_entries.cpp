#include "behaviour/memory_entries.h"

#include <algorithm>
#include <cmath>

namespace mrose {

void explainSelf(const OwnBelief& self, Nanoseconds now, MemoryEntries& entries) {
    if (self.known == 0) {
        entries.add("own pose", "not known yet");
        return;
    }
    entries.add("own x", self.pose.x, "m");
    entries.add("own y", self.pose.y, "m");
    entries.add("own heading", wrapAngle(self.pose.heading), "rad");
    entries.add("own place, std. dev.", std::sqrt(self.positionVariance), "m");
    entries.add("own heading, std. dev.", std::sqrt(self.headingVariance), "rad");
    entries.add("own pose measured, age", toSeconds(now - self.measured), "s");
    entries.add("measurements refused", static_cast<double>(self.refused));
}

void explainBall(const BallBelief& ball, Nanoseconds now, MemoryEntries& entries) {
    if (ball.known == 0) {
        entries.add("ball", "not seen, or lost");
        return;
    }
    entries.add("ball x", ball.position.x, "m");
    entries.add("ball y", ball.position.y, "m");
    entries.add("ball vx", ball.velocity.x, "m/s");
    entries.add("ball vy", ball.velocity.y, "m/s");
    entries.add("ball place, std. dev.", std::sqrt(ball.variance), "m");
    entries.add("ball seen, age", toSeconds(now - ball.seen), "s");
    entries.add("ball missing for", ball.missing, "s");
}

void explainBackOff(const BackOff& backOff, Nanoseconds now, MemoryEntries& entries) {
    entries.add("hardly moving for", backOff.hardlyMoving, "s");
    entries.add("backs off for", toSeconds(std::max<Nanoseconds>(0, backOff.until - now)), "s");
    entries.add("times backed off", static_cast<double>(backOff.times));
}

}  // namespace mrose
