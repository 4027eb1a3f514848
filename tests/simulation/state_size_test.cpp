// How much memory a state takes: what rewinding and branching cost is copies of it.
#include <gtest/gtest.h>

#include "behaviour/chase_ball.h"
#include "behaviour/go_to_pose.h"
#include "behaviour/wander.h"
#include "simulation/small_world.h"
#include "support/shipped.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

template <class T>
std::size_t heldBy(const std::vector<T>& values) {
    return values.capacity() * sizeof(T);
}

/// All memory that the value holds, B.
std::size_t heldBy(const WorldState& s) {
    return sizeof s + heldBy(s.robots) + heldBy(s.objects) + heldBy(s.contacts) + heldBy(s.kicks) + heldBy(s.messages) +
           heldBy(s.goals) + heldBy(s.commands) + heldBy(s.motion) + heldBy(s.memory) + heldBy(s.sensing) +
           heldBy(s.past) + heldBy(s.touches);
}

/// Eight robots and a ball in a field in which they keep touching.
Scenario eight(const RobotType& type, const std::shared_ptr<const MotionModel>& model,
               const std::shared_ptr<const Controller>& controller) {
    SmallWorld world(walledField(5, 4));
    for (int i = 0; i < 8; ++i)
        world.robot(type, {0.7 + 1.2 * (i % 4), 1.0 + 2.0 * (i / 4), 0.8 * i}, controller, model, i % 5);
    world.object(ballType(), {2.5, 2, 0});
    return world.scenario();
}

struct Sizes {
    std::size_t all = 0;
    std::size_t memories = 0, sensing = 0;  ///< of that, the controllers' memories; what sensors remember, and the past
};

/// Of the largest copy within half a minute.
Sizes largestOf(const Scenario& scenario) {
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    Sizes largest;
    for (int k = 0; k < 1500; ++k) {
        step(scenario, state, buffers);
        const WorldState copy = state;
        largest = {std::max(largest.all, heldBy(copy)), heldBy(copy.memory), heldBy(copy.sensing) + heldBy(copy.past)};
        // Its bytes as written hold every field once, without what pads them.
        EXPECT_LE(stateBytes(copy).size(), heldBy(copy) + 200) << "a part is not counted";
    }
    return largest;
}

/// The world's part of a state fits for every robot that ships; what controllers and sensors remember comes on top.
TEST(StateSize, OfEightRobotsIsAtMostEightKilobytesAndOfTheirMemories896BytesEach) {
    const std::pair<const char*, std::shared_ptr<const Controller>> controllers[] = {
        {"random commands", std::make_shared<const RandomCommands>(-0.2, 0.5, 1)},
        {"chase_ball", std::make_shared<const ChaseBall>(ChaseBall::Options{.target = {5, 2}})},
        {"go_to_pose",
         std::make_shared<const GoToPose>(GoToPose::Options{.targets = {{1, 1, 0}, {4, 3, 2}}, .loop = true})},
        {"wander", std::make_shared<const Wander>(Wander::Options{})}};
    std::vector<std::tuple<std::string, RobotType, std::shared_ptr<const MotionModel>>> robots;
    for (const char* name : {"pioneer1", "nomad200", "create", "husky", "b21", "human"}) {
        const RobotDescription robot = shippedRobot(name);
        robots.emplace_back(name, robot.type, motionOf(robot));
    }
    robots.emplace_back("create_paper", shippedRobot("create").type, shippedModel("create_paper", "1"));
    for (const auto& [name, type, model] : robots)
        for (const auto& [kind, controller] : controllers) {
            const Sizes sizes = largestOf(eight(type, model, controller));
            EXPECT_LE(sizes.all - sizes.memories - sizes.sensing, 8192u) << name << " with " << kind;
            EXPECT_LE(sizes.memories, 8u * 896) << name << " with " << kind;
            EXPECT_LE(sizes.sensing, 8u * 1280) << name << " with " << kind;
        }
}

/// With the step by Box2D's world it was 4.2 KB. Contacts come and go: the mean of a minute.
TEST(StateSize, EightRobotsThatCollideTakeNoMoreThanWithBox2DsWorld) {
    const Scenario scenario = fieldScenario({});
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    std::size_t sum = 0;
    constexpr std::size_t ticks = 3000;
    for (std::size_t k = 0; k < ticks; ++k) {
        step(scenario, state, buffers);
        sum += stateBytes(state).size();
    }
    EXPECT_LE(sum / ticks, 4200u);
    EXPECT_GT(sum / ticks, 2000u);
}

}  // namespace
}  // namespace mrose
