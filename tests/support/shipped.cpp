#include "support/shipped.h"

#include <gtest/gtest.h>

#include "motion/learned_model.h"
#include "scenario/description_file.h"
#include "support/places.h"
#include "support/test_data.h"

namespace mrose {
namespace {

template <class T>
T descriptionOf(const std::filesystem::path& file) {
    std::vector<std::filesystem::path> logs;
    if (const auto data = realData()) logs = {*data, *data / "mrclam"};
    DiskDescriptions source({sourceFolder(), logs, ""});
    auto description = loadDescription((sourceFolder() / file).string(), source);
    EXPECT_TRUE(description) << description.error().message();
    return std::get<T>(std::move(*description));
}

}  // namespace

RobotDescription shippedRobot(const std::string& name) {
    return descriptionOf<RobotDescription>("resources/robots/" + name + ".toml");
}

std::shared_ptr<const MotionModel> motionOf(const RobotDescription& description, const std::string& robot) {
    std::shared_ptr<const MotionModel> model = description.model;
    if (description.motion)
        model = std::make_shared<const LearnedModel>(
            description.motion, robot.empty() ? description.motionRobot : robot, description.motionDraw);
    return withNoise(std::move(model), description.motionNoise);
}

RobotKinds shippedKinds() {
    auto kinds = readRobotKinds(sourceFolder() / "resources" / "robots");
    EXPECT_TRUE(kinds) << kinds.error().message();
    return kinds.value_or(RobotKinds{});
}

std::shared_ptr<const MotionModel> shippedModel(const std::string& network, const std::string& robot) {
    auto loaded = loadNetwork(sourceFolder() / "nets" / (network + ".net"));
    EXPECT_TRUE(loaded) << loaded.error().message();
    return std::make_shared<const LearnedModel>(std::make_shared<const LearnedMotion>(std::move(*loaded)), robot);
}

std::shared_ptr<const Shape> shippedShape(const std::string& name) {
    return std::make_shared<const Shape>(descriptionOf<Shape>("shapes/" + name + ".toml"));
}

Environment shippedEnvironment(const std::string& name) {
    return descriptionOf<Environment>("resources/environments/" + name + ".toml");
}

Scenario shippedScenario(const std::string& name) {
    return Scenario(descriptionOf<LoadedScenario>("resources/scenarios/" + name + ".toml").parts);
}

}  // namespace mrose
