#pragma once

#include <memory>
#include <string>
#include <vector>

#include "assessment/compare.h"
#include "logs/robot_log.h"
#include "motion/learned_model.h"

namespace mrose {

/// One simulated robot for each robot of a log, told to play it, and nothing else.
ScenarioParts playersOf(const Log& log, const std::vector<std::shared_ptr<const MotionModel>>& models);

/// The same model for every robot.
ScenarioParts playersOf(const Log& log, const std::shared_ptr<const MotionModel>& model);

/// For each robot of the log its own model of a network that ships.
std::vector<std::shared_ptr<const MotionModel>> learnedModels(const Log& log, const std::string& network);

/// A kinematic model with everything: dead times that are no multiple of a tick, lags, gains, biases, limits.
std::shared_ptr<const MotionModel> wearyModel();

/// The synthetic log that ships: one robot, six trajectories.
Log shippedLog();

}  // namespace mrose
