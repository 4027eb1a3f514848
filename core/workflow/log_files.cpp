#include "workflow/log_files.h"

#include <algorithm>

#include "assessment/rollout.h"
#include "io/format.h"
#include "logs/log_reader.h"
#include "motion/noisy_model.h"
#include "workflow/resources.h"

namespace mrose {

Expected<Log> openLog(const std::string& source, const std::vector<std::string>& robots,
                      const std::optional<DifferentialDrive>& drive) {
    LogOptions options;
    if (drive) options.drive = *drive;
    const auto place = existingLog(source);
    if (!place) return tl::unexpected(place.error());
    auto log = readLog(*place, options);
    if (!log || robots.empty()) return log;
    std::vector<RobotLog> chosen;
    for (const std::string& name : robots) {
        const auto found = std::find_if(log->robots.begin(), log->robots.end(),
                                        [&](const RobotLog& robot) { return robot.robot == name; });
        if (found == log->robots.end()) return fail(source, "has no robot \"" + name + '"');
        const bool again =
            std::any_of(chosen.begin(), chosen.end(), [&](const RobotLog& r) { return r.robot == name; });
        if (!again) chosen.push_back(*found);
    }
    log->robots = std::move(chosen);
    return log;
}

Expected<std::shared_ptr<const LearnedMotion>> openNetwork(const std::string& path) {
    auto network = loadNetwork(path);
    if (!network) return tl::unexpected(network.error());
    const Nanoseconds step = RolloutOptions{}.step;
    if (step % network->period != 0)
        return fail(path,
                    "is " + numberText(toSeconds(network->period)) + "; expected a period that divides " +
                        numberText(toSeconds(step)) + " s, the step of predictions",
                    0, "period_s");
    return std::make_shared<const LearnedMotion>(std::move(*network));
}

RobotModels learnedModels(const std::shared_ptr<const LearnedMotion>& motion, const Log& log, MotionDraw draw) {
    RobotModels models{motion->network().form == MotionNetwork::Form::state ? "paper's network" : "network", {}};
    for (const RobotLog& robot : log.robots)
        models.byRobot.emplace(robot.robot, std::make_unique<LearnedModel>(motion, robot.robot, draw));
    return models;
}

RobotModels constantNoiseModels(const std::shared_ptr<const LearnedMotion>& motion, const Log& log) {
    const MotionNoise noise = motion->network().noise->constant.value();
    RobotModels models{"constant noise", {}};
    for (const RobotLog& robot : log.robots)
        models.byRobot.emplace(robot.robot,
                               std::make_unique<NoisyModel>(
                                   std::make_shared<const LearnedModel>(motion, robot.robot, MotionDraw::mean), noise));
    return models;
}

NamedModel named(const RobotModels& models) {
    return {models.name, [&models](const std::string& robot) -> const MotionModel* {
                const auto found = models.byRobot.find(robot);
                return found == models.byRobot.end() ? nullptr : found->second.get();
            }};
}

}  // namespace mrose
