#pragma once

#include <vector>

#include "logs/robot_log.h"

namespace mrose {

/// Ground truth that is elsewhere all at once, as where a tracker has lost a robot and found something else.
struct TruthJump {
    Nanoseconds before = 0, after = 0;  ///< stamps of the poses between which it jumps
    double distance = 0, turn = 0;      ///< m, rad; at least 0
};

/// So far from a jump the truth of an instant, which is fitted to poses on both sides, does not know of it; a velocity
/// at twice that.
constexpr Nanoseconds truthSmoothed = 100'000'000;

/// The jumps within (from, to]: since the pose changed last it has moved by 10 cm, or turned by 0.3 rad, more than at
/// twice the speeds that the robot was commanded within 2 s before. (Trackers that repeat a pose until they know the
/// next one move in stairs.) None where its commands are not known.
std::vector<TruthJump> truthJumps(const Trajectory& trajectory, Nanoseconds from, Nanoseconds to);

/// The tracked heading turns all at once: from one pose to the next that differs otherwise than between most of the
/// five before and the five after, which lie within half a second; by 12 mrad and more, and by ten times what is usual.
/// (Of white noise alone so much is one in 10^12 poses.) Trackers do that where they take other markers for the
/// robot's, and robots hardly do; how the tracked point lies on the robot may change there.
struct HeadingStep {
    Nanoseconds time = 0;   ///< of the pose after it
    Nanoseconds known = 0;  ///< of the pose by which it is known
};
std::vector<HeadingStep> headingSteps(const Trajectory& trajectory);

}  // namespace mrose
