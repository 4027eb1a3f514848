#pragma once

#include <string>

#include "io/error.h"
#include "logs/robot_log.h"
#include "scenario/robot_kind.h"
#include "scenario/scenario_value.h"

namespace mrose {

/// Whether the log itself says what kind of robot drove; false: scenarioOfLog() needs a robot file.
bool namesRobotKind(const Log& log, const RobotKinds& kinds);

/// Whether a log can be compared at all, whatever drove: to be known before that is asked for. `robots`: only these;
/// empty: all of which the log has both commands and ground truth. Error: one of them has no trajectory with commands
/// and ground truth of the same time; they are too far off for metres.
Expected<void> checkPlayable(const Log& log, const RobotKinds& kinds, const std::vector<std::string>& robots = {});

/// A scenario for a log that is opened without one: a robot for each of the log's, which plays it and reads the sensors
/// that reported subjects there, those of them that it has. The kind that the log names says which robots they are and
/// where they drove; without such a place it is an open one. `robotFile`: what kind the robots are, where the log does
/// not say it (CSV); it may be given for any log. A value for loadScenario(), with the names of files that it needs;
/// `log` is the place of the log as it is written there. Error: the log names no kind of robot and none is given; it
/// has no robots; they are too far off for metres.
Expected<ScenarioValue> scenarioOfLog(const Log& log, const std::string& place, const RobotKinds& kinds,
                                      const std::string& robotFile = "");

}  // namespace mrose
