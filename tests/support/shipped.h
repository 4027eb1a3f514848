#pragma once

#include <memory>
#include <string>

#include "scenario/robot_file.h"
#include "scenario/scenario.h"

namespace mrose {

/// The kinds of robots that ship.
RobotKinds shippedKinds();

/// What the robot file of that name, which ships, describes: "create" of resources/robots/create.toml.
RobotDescription shippedRobot(const std::string& name);

/// How it moves; `robot` is which of its network's robots it is, "" the one of its file.
std::shared_ptr<const MotionModel> motionOf(const RobotDescription& description, const std::string& robot = "");

/// The same for a network that ships: "create_paper" of nets/create_paper.net.
std::shared_ptr<const MotionModel> shippedModel(const std::string& network, const std::string& robot = "");

/// An outline that ships: "husky" of shapes/husky.toml.
std::shared_ptr<const Shape> shippedShape(const std::string& name);

/// A place that ships: "midsize_2001" of resources/environments/midsize_2001.toml.
Environment shippedEnvironment(const std::string& name);

/// A scenario that ships: "soccer". Logs are looked for in the folder of real logs.
Scenario shippedScenario(const std::string& name);

}  // namespace mrose
