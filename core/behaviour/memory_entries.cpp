#include "behaviour/memory_entries.h"

#include <algorithm>
#include <cmath>

namespace mrose {

void explainSelf(const OwnBelief& self, Nanoseconds now, std::vector<MemoryEntry>& entries) {
    if (self.known == 0) {
        entries.push_back({.name = "own pose", .text = "not known yet"});
        return;
    }
    entries.push_back({"own x", self.pose.x, "m"});
    entries.push_back({"own y", self.pose.y, "m"});
    entries.push_back({"own heading", wrapAngle(self.pose.heading), "rad"});
    entries.push_back({"own place, std. dev.", std::sqrt(self.positionVariance), "m"});
    entries.push_back({"own heading, std. dev.", std::sqrt(self.headingVariance), "rad"});
    entries.push_back({"own pose measured, age", toSeconds(now - self.measured), "s"});
    entries.push_back({"measurements refused", static_cast<double>(self.refused)});
}

void explainBall(const BallBelief& ball, Nanoseconds now, std::vector<MemoryEntry>& entries) {
    if (ball.known == 0) {
        entries.push_back({.name = "ball", .text = "not seen, or lost"});
        return;
    }
    entries.push_back({"ball x", ball.position.x, "m"});
    entries.push_back({"ball y", ball.position.y, "m"});
    entries.push_back({"ball vx", ball.velocity.x, "m/s"});
    entries.push_back({"ball vy", ball.velocity.y, "m/s"});
    entries.push_back({"ball place, std. dev.", std::sqrt(ball.variance), "m"});
    entries.push_back({"ball seen, age", toSeconds(now - ball.seen), "s"});
    entries.push_back({"ball missing for", ball.missing, "s"});
}

void explainBackOff(const BackOff& backOff, Nanoseconds now, std::vector<MemoryEntry>& entries) {
    entries.push_back({"hardly moving for", backOff.hardlyMoving, "s"});
    entries.push_back({"backs off for", toSeconds(std::max<Nanoseconds>(0, backOff.until - now)), "s"});
    entries.push_back({"times backed off", static_cast<double>(backOff.times)});
}

}  // namespace mrose
