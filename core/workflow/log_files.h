#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assessment/evaluate.h"
#include "io/error.h"
#include "logs/robot_log.h"
#include "motion/learned_model.h"

namespace mrose {

/// Opens the log of that name (placeOfLog()); `drive` is for logs of wheel commands. Robots not in `robots` are left
/// out, unless it is empty. Error: an unknown robot too.
Expected<Log> openLog(const std::string& source, const std::vector<std::string>& robots,
                      const std::optional<DifferentialDrive>& drive = {});

/// Loads a network and makes it ready for use. Error: a period that predictions of logs cannot be made with, too.
Expected<std::shared_ptr<const LearnedMotion>> openNetwork(const std::string& path);

/// One motion model for each robot of a log, under one name.
struct RobotModels {
    std::string name;
    std::map<std::string, std::unique_ptr<MotionModel>> byRobot;
};
RobotModels learnedModels(const std::shared_ptr<const LearnedMotion>& motion, const Log& log,
                          MotionDraw draw = MotionDraw::mean);
/// The network's mean with the constant noise that is known of it (ResidualNoise::constant).
RobotModels constantNoiseModels(const std::shared_ptr<const LearnedMotion>& motion, const Log& log);
/// The view that an evaluation takes; `models` must outlive it.
NamedModel named(const RobotModels& models);

}  // namespace mrose
