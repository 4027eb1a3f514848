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

/// What was identified for a robot, or else the mean of the others.
KinematicParameters parametersOf(const MotionNetwork& network, const std::string& robot) {
    KinematicParameters mean;
    const auto add = [&](KinematicParameters::Channel& to, const KinematicParameters::Channel& from, bool first) {
        if (first) to.gain = 0;
        const double share = 1.0 / static_cast<double>(network.identified.size());
        to.deadTime += share * from.deadTime;
        to.lag += share * from.lag;
        to.gain += share * from.gain;
    };
    for (const auto& identified : network.identified) {
        if (identified.robot == robot) return identified.kinematics;
        const bool first = &identified == &network.identified.front();
        add(mean.v, identified.kinematics.v, first);
        add(mean.w, identified.kinematics.w, first);
    }
    return mean;
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
    baselines.push_back(modelsOf("+ dead time", log, [&](const std::string& robot) {
        const KinematicParameters all = parametersOf(network, robot);
        KinematicParameters p;
        // The whole delay: a step's mean response comes a dead time and a lag late.
        p.v.deadTime = all.v.deadTime + all.v.lag;
        p.w.deadTime = all.w.deadTime + all.w.lag;
        return std::make_unique<KinematicModel>(p, network.period);
    }));
    baselines.push_back(modelsOf("+ lag, gains, biases", log, [&](const std::string& robot) {
        return std::make_unique<KinematicModel>(parametersOf(network, robot), network.period);
    }));
    return baselines;
}

}  // namespace mrose::cli
