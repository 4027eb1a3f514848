#include "simulation/shipped_crowd.h"

#include "behaviour/chase_ball.h"
#include "behaviour/command_player.h"
#include "behaviour/go_to_pose.h"
#include "behaviour/wander.h"
#include "motion/learned_model.h"
#include "simulation/small_world.h"
#include "support/shipped.h"

namespace mrose {
namespace {

constexpr double width = 6, height = 4;

struct CrowdKind {
    std::string name;
    RobotType type;
    std::shared_ptr<const MotionModel> model;
};

std::vector<CrowdKind> kindsThatShip() {
    std::vector<CrowdKind> kinds;
    for (const char* name : {"pioneer1", "nomad200", "husky", "b21", "human", "pioneer1", "nomad200"}) {
        const RobotDescription robot = shippedRobot(name);
        kinds.push_back({name, robot.type, motionOf(robot)});
    }
    const RobotDescription create = shippedRobot("create");
    for (const char* robot : {"1", "2", "3", "4", "5"})
        kinds.push_back({"create", create.type, motionOf(create, robot)});
    for (const char* robot : {"1", "5"})
        kinds.push_back({"create of 2002", create.type, shippedModel("create_paper", robot)});
    return kinds;
}

std::vector<std::shared_ptr<const Controller>> controllersThatShip() {
    std::vector<StampedCommand> script;
    for (int i = 0; i < 600; ++i) script.push_back({i * 77'000'001LL, {0.35 - 0.05 * (i % 9), i % 7 * 0.2 - 0.6}});
    return {std::make_shared<const ChaseBall>(ChaseBall::Options{.target = {width, height / 2}}),
            std::make_shared<const ChaseBall>(ChaseBall::Options{.target = {0, height / 2}}),
            std::make_shared<const Wander>(Wander::Options{}),
            std::make_shared<const GoToPose>(
                GoToPose::Options{.targets = {{1, 1, 0}, {width - 1, height - 1, 2}}, .loop = true, .backwards = true}),
            std::make_shared<const CommandPlayer>(script)};
}

}  // namespace

Scenario shippedCrowd(bool noise) {
    SmallWorld world(walledField(width, height));
    if (noise) world.parts().scene.randomFactor = 0.3;
    const std::vector<CrowdKind> kinds = kindsThatShip();
    const auto controllers = controllersThatShip();
    const auto wild = std::make_shared<const RandomCommands>(-0.1, 0.4, 1.5);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const Pose start{0.75 + 1.1 * static_cast<double>(i % 5), 0.7 + 1.25 * static_cast<double>(i / 5),
                         1.3 * static_cast<double>(i)};
        world.robot(kinds[i].type, start, noise ? controllers[i % controllers.size()] : wild,
                    noise ? kinds[i].model : meanOf(withNoise(kinds[i].model, {})), static_cast<std::int64_t>(i % 5));
    }
    ObjectType ball = ballType(), box = boxType();
    ball.shape = shippedShape("ball");
    box.shape = shippedShape("box");
    world.object(ball, {1.3, 1.3, 0}, {0.5, 0.3, 1}).object(box, {5.4, 3.2, 0.4}).object(box, {2.4, 1.3, 0.4});
    return world.scenario();
}

}  // namespace mrose
