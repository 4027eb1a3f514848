#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "assessment/evaluate.h"
#include "motion/learned_model.h"
#include "report/evaluation_report.h"

namespace mrose {

/// One motion model for each robot of a log, under one name.
struct RobotModels {
    std::string name;
    std::map<std::string, std::unique_ptr<MotionModel>> byRobot;
};

/// The view that an evaluation takes; `models` must outlive it.
NamedModel named(const RobotModels& models);

/// What a report by that command says about a network.
ReportContext reportContext(const MotionNetwork& network, const std::string& path, const std::string& commandLine);

RobotModels learnedModels(const std::shared_ptr<const LearnedMotion>& motion, const Log& log);

/// What a network is compared with: velocity = command; the same after the identified dead time; with lag, gains and
/// biases as well. Their parameters were identified from the logs that the network was learned from.
std::vector<RobotModels> kinematicModels(const MotionNetwork& network, const Log& log);

}  // namespace mrose
