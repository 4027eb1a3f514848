#include "experiment/trial_world.h"

#include "motion/noisy_model.h"
#include "simulation/small_world.h"

namespace mrose {

ScenarioParts trialWorld() {
    const RobotType type = discRobot(0.2);
    const auto drive = withNoise(ideal(), {0.02, 0.02, 0.02});
    const auto commands = std::make_shared<const RandomCommands>(-0.2, 1, 3);
    Environment field = walledField(4, 3);
    field.goals.push_back({"east", {{3.5, 0}, {4, 0}, {4, 3}, {3.5, 3}}});
    SmallWorld world(std::move(field));
    world.robot(type, {1, 1, 0.3}, commands, drive).robot(type, {2.5, 2, -2}, commands, drive, 2);
    world.object(ballType(), {2, 1.2, 0}, {0.5, 0.2, 0});
    ScenarioParts parts = std::move(world.parts());
    parts.name = "trials";
    parts.scene.randomFactor = 0.1;
    parts.variation = {0.2, 0.5, 0.15, 0.3, 0.4};
    return parts;
}

}  // namespace mrose
