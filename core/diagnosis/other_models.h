#pragma once

#include <memory>
#include <string>
#include <vector>

#include "assessment/log_world.h"
#include "motion/learned_model.h"

namespace mrose {

/// A motion model to try instead of a robot's own.
struct OtherModel {
    std::string name;
    std::vector<std::shared_ptr<const MotionModel>> byRobot;  ///< by compared robot; null: not for this one
};

/// A network for all robots but those that move by it already. Null for all: nothing is left to try.
OtherModel otherNetwork(const std::string& name, const std::shared_ptr<const LearnedMotion>& motion,
                        const LogWorld& world);

/// The kinematics that the networks of the robots are compared with (kinematic_baselines.h), those of a robot that
/// moves by no network: velocity = command alone. Their period is a tick, so that a command acts when it was issued.
std::vector<OtherModel> otherKinematics(const LogWorld& world);

/// As `mrose evaluate` calls it: "velocity = command", "+ dead time", "+ lag, gains, biases"; the name of a network as
/// it is.
std::string briefName(const std::string& model);

/// The network that a compared robot moves by; null where it moves by none.
const MotionNetwork* networkOf(const LogWorld& world, std::size_t robot);

}  // namespace mrose
