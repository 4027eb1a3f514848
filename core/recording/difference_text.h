#pragma once

#include <string>

#include "scenario/scenario.h"
#include "world/state_difference.h"

namespace mrose {

/// A difference of two states of a scenario in words that name whose it is: "robot 2 (goalie) pose.x: recorded 1.25,
/// now 1.2500001"; "controller memory of robot 1 (striker), byte 16: recorded 3, now 4". `state` is any of the
/// scenario.
std::string differenceText(const Scenario& scenario, const WorldState& state, const StateDifference& difference);

/// "robot 2 (goalie)", counted from 1.
std::string robotText(const Scenario& scenario, std::size_t robot);

}  // namespace mrose
