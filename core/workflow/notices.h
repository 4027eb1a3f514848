#pragma once

#include <string>
#include <vector>

#include "assessment/log_world.h"
#include "logs/robot_log.h"
#include "motion/motion_network.h"
#include "perception/sensor_network.h"
#include "report/page.h"
#include "scenario/scenario.h"

namespace mrose {

/// The kind of robot that drove in a log, by the robot files that ship; "" where the log does not say it.
std::string robotKind(const Log& log);

/// What must be known of a log before its figures are believed, a sentence each: what is missing of it, what looks like
/// other units.
std::vector<std::string> noticesOf(const Log& log);

/// What a report of a learned network begins with: the program, the command that it was made by, the logs.
ReportContext contextOf(const NetworkTraining& training, const std::string& command);

/// The networks that a scenario's log players move by, each once.
std::vector<const MotionNetwork*> networksOf(const ScenarioParts& parts);

/// What must be known of a network and a log before the errors of the one on the other are believed, a sentence each:
/// another kind of robot, robots that it was not learned from, a log that it was learned from, that it knows no noise.
/// `heldOutOnly`: the log is but the part that was kept from learning.
std::vector<std::string> noticesOf(const MotionNetwork& network, const Log& log, bool heldOutOnly = false);
/// Of these, those that say of another robot or kind of robot.
std::vector<std::string> otherRobotNotices(const MotionNetwork& network, const Log& log);
/// The same of a sensor and those robots of a log that are judged.
std::vector<std::string> noticesOf(const SensorNetwork& network, const Log& log,
                                   const std::vector<std::string>& robots);
/// The same of the robots of a log that are compared. Where the log names no kind of robot, theirs is that of their
/// motion.
std::vector<std::string> noticesOf(const MotionNetwork& network, const LogWorld& world);
/// Of a network that is put beside the judged one, by its name: that it was learned from the log; empty: it was not.
std::string besideNotice(const std::string& name, const NetworkTraining& training, const Log& log);
/// Of a network in a compared world, that it is of another kind of robot; empty: it is not.
std::string otherKindNotice(const MotionNetwork& network, const LogWorld& world);

}  // namespace mrose
