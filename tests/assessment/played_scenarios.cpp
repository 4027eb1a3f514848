#include "assessment/played_scenarios.h"

#include <gtest/gtest.h>

#include "behaviour/command_player.h"
#include "logs/log_reader.h"
#include "motion/kinematic.h"
#include "support/places.h"
#include "support/scenes.h"

namespace mrose {

ScenarioParts playersOf(const Log& log, const std::vector<std::shared_ptr<const MotionModel>>& models) {
    ScenarioParts parts;
    parts.name = "played";
    parts.scene.robotTypes.push_back(discRobot(0.17, 4.5));
    parts.scene.models = models;
    for (std::uint32_t i = 0; i < log.robots.size(); ++i) {
        parts.scene.robots.push_back({"simulated " + log.robots[i].robot, 0, i, 3, {}});
        parts.controllers.push_back(std::make_shared<CommandPlayer>(std::vector<StampedCommand>()));
        parts.players.push_back({i, {log.source, log.source, log.robots[i].robot, "", 0}});
    }
    return parts;
}

ScenarioParts playersOf(const Log& log, const std::shared_ptr<const MotionModel>& model) {
    return playersOf(log, std::vector(log.robots.size(), model));
}

std::vector<std::shared_ptr<const MotionModel>> learnedModels(const Log& log, const std::string& network) {
    auto loaded = loadNetwork(sourceFolder() / "nets" / network);
    EXPECT_TRUE(loaded) << loaded.error().message();
    const auto motion = std::make_shared<const LearnedMotion>(std::move(*loaded));
    std::vector<std::shared_ptr<const MotionModel>> models;
    for (const RobotLog& robot : log.robots) models.push_back(std::make_shared<LearnedModel>(motion, robot.robot));
    return models;
}

std::shared_ptr<const MotionModel> wearyModel() {
    KinematicParameters parameters;
    parameters.v = {0.213, 0.11, 0.93, 0.002, 0.5, 2.5};
    parameters.w = {0.171, 0.14, 1.04, -0.003, 2, 9};
    parameters.lateralPerRotation = 0.004;
    return std::make_shared<const KinematicModel>(parameters, 20'000'000);
}

Log shippedLog() {
    auto log = readLog(sourceFolder() / "resources/logs/pioneer");
    EXPECT_TRUE(log) << log.error().message();
    return std::move(*log);
}

}  // namespace mrose
