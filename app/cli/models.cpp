#include "models.h"

#include "motion/kinematic.h"

namespace mrose::cli {
namespace {

template <class MakeModel>
RobotModels modelsOf(std::string name, const Log& log, MakeModel make) {
    RobotModels models{std::move(name), {}};
    for (const RobotLog& robot : log.robots) models.byRobot.emplace(robot.robot, make(robot.robot));
    return models;
}

using Identified = MotionNetwork::Identified;

/// What was identified for a robot; for an unknown one the first of the known stands in.
const Identified& identifiedOf(const MotionNetwork& network, const std::string& robot) {
    for (const Identified& identified : network.identified)
        if (identified.robot == robot) return identified;
    return network.identified.front();
}

}  // namespace

NamedModel named(const RobotModels& models) {
    return {models.name, [&models](const std::string& robot) -> const MotionModel* {
                const auto found = models.byRobot.find(robot);
                return found == models.byRobot.end() ? nullptr : found->second.get();
            }};
}

RobotModels learnedModels(const std::shared_ptr<const LearnedMotion>& motion, const Log& log) {
    const std::string name = motion->network().form == MotionNetwork::Form::state ? "paper's network" : "network";
    return modelsOf(name, log, [&](const std::string& robot) { return std::make_unique<LearnedModel>(motion, robot); });
}

std::vector<RobotModels> kinematicBaselines(const MotionNetwork& network, const Log& log) {
    std::vector<RobotModels> baselines;
    baselines.push_back(modelsOf("velocity = command", log, [&](const std::string&) {
        return std::make_unique<KinematicModel>(KinematicParameters{}, network.period);
    }));
    if (network.identified.empty()) return baselines;
    for (const auto& [name, member] : {std::pair{"+ dead time", &Identified::delayed},
                                       std::pair{"+ lag, gains, biases", &Identified::dynamic}})
        baselines.push_back(modelsOf(name, log, [&, fitted = member](const std::string& robot) {
            return std::make_unique<KinematicModel>(identifiedOf(network, robot).*fitted, network.period);
        }));
    return baselines;
}

}  // namespace mrose::cli
