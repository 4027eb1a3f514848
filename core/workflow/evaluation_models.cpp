#include "workflow/evaluation_models.h"

#include "io/format.h"
#include "motion/kinematic_baselines.h"
#include "workflow/notices.h"
#include "workflow/version.h"

namespace mrose {
namespace {

template <class MakeModel>
RobotModels modelsOf(std::string name, const Log& log, MakeModel make) {
    RobotModels models{std::move(name), {}};
    for (const RobotLog& robot : log.robots) models.byRobot.emplace(robot.robot, make(robot.robot));
    return models;
}

}  // namespace

NamedModel named(const RobotModels& models) {
    return {models.name, [&models](const std::string& robot) -> const MotionModel* {
                const auto found = models.byRobot.find(robot);
                return found == models.byRobot.end() ? nullptr : found->second.get();
            }};
}

ReportContext reportContext(const MotionNetwork& network, const std::string& path, const std::string& commandLine) {
    ReportContext context;
    context.program = "mrose " MROSE_VERSION;
    context.commandLine = commandLine;
    for (const auto& source : network.training.logs) context.trainingLogs.push_back({source.path, source.hash});
    const auto fact = [&](const char* name, std::string value) {
        context.modelFacts.emplace_back(name, std::move(value));
    };
    fact("file", path);
    fact("form", network.form == MotionNetwork::Form::state
                     ? "state: (v, w, commands) to motion and next velocity"
                     : "history: commands of the last tenths of a second to motion");
    fact("robot", network.robotType + (network.synthetic ? " (synthetic)" : ""));
    fact("period", fixed(1000 * toSeconds(network.period), 0) + " ms");
    fact("layers", std::to_string(network.mlp.shape.inputs) + " inputs, " + std::to_string(network.mlp.shape.hidden) +
                       " tanh, " + std::to_string(network.mlp.shape.outputs) + " outputs");
    for (const MotionNetwork::Identified& robot : network.identified)
        fact("dead time", "robot " + robot.robot + ": v " + fixed(1000 * robot.v.deadTime, 0) + " ± " +
                              fixed(1000 * robot.v.deadTimeError, 0) + " ms, w " + fixed(1000 * robot.w.deadTime, 0) +
                              " ± " + fixed(1000 * robot.w.deadTimeError, 0) + " ms");
    fact("learned by", network.training.method + ", loss " + network.training.loss + ", seed " +
                           std::to_string(network.training.seed) + ", " + std::to_string(network.training.patterns) +
                           " patterns, " + std::to_string(network.training.epochs) + " epochs");
    fact("command", network.training.command);
    if (network.heldOut.part.holdsAny()) fact("kept from learning", keptFromLearning(network.heldOut.part));
    fact("held out in learning", "P " + fixed(network.heldOut.position, 2) + " %, Hd " +
                                     fixed(network.heldOut.heading, 2) + " % over " +
                                     fixed(network.heldOut.horizon, 1) + " s (each member on its own part)");
    return context;
}

RobotModels learnedModels(const std::shared_ptr<const LearnedMotion>& motion, const Log& log) {
    const std::string name = motion->network().form == MotionNetwork::Form::state ? "paper's network" : "network";
    return modelsOf(name, log, [&](const std::string& robot) { return std::make_unique<LearnedModel>(motion, robot); });
}

std::vector<RobotModels> kinematicModels(const MotionNetwork& network, const Log& log) {
    // A command acts when it was issued, not at the next period of some network.
    constexpr Nanoseconds period = 10'000'000;
    std::vector<RobotModels> baselines;
    const std::vector<KinematicBaseline> named = kinematicBaselines(network, {});
    for (std::size_t i = 0; i < named.size(); ++i)
        baselines.push_back(modelsOf(named[i].name, log, [&](const std::string& robot) {
            return std::make_unique<KinematicModel>(kinematicBaselines(network, robot)[i].parameters, period);
        }));
    return baselines;
}

}  // namespace mrose
