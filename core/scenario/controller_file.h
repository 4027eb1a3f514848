#pragma once

#include <memory>
#include <string>
#include <vector>

#include "behaviour/floor_plan.h"
#include "control/controller.h"
#include "geometry/pose.h"
#include "io/toml_table.h"
#include "scenario/description_library.h"
#include "scenario/robot_file.h"
#include "scenario/scenario_file.h"
#include "scene/environment.h"

namespace mrose {

/// What a scenario file says about who drives a robot.
struct ControllerSetting {
    std::shared_ptr<const Controller> controller;  ///< nothing after an error, which the table remembers
    std::optional<Pose> logStart = {};             ///< of a log player: where the real robot was
    std::optional<LogExcerpt> played = {};         ///< of a log player
    std::vector<StampedCommand> sent = {};         ///< of a log player: SceneRobot::sent
};

/// A robot or person of the scenario, as others name it.
struct NamedRobot {
    std::string name, team;
};

/// Whom it drives: options that the file leaves out are derived from the robot.
struct DrivenRobot {
    const RobotDescription& robot;
    double ballRadius = 0;  ///< m, of the scenario's ball; 0 where there is none
    std::shared_ptr<const FloorPlan> walls;
    const Environment& environment;
    const std::vector<NamedRobot>& robots;  ///< all of the scenario
    std::size_t index = 0;                  ///< its own among them
};

/// Reads `controller = { kind = ..., ... }` of the scenario file called `from`. resources/README.md lists the kinds and
/// their options. A plug-in that is not to be loaded gives its robot no commands.
ControllerSetting readController(TomlTable table, const DrivenRobot& driven, const std::string& from,
                                 DescriptionLibrary& library, const ScenarioLoading& loading);

/// Of a robot without a controller: it stands.
std::shared_ptr<const Controller> noController();

}  // namespace mrose
