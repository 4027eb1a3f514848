// Friction between bodies and with the floor, and its random factor, against closed forms.
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "scene/floor_motion.h"
#include "simulation/small_world.h"

namespace mrose {
namespace {

ObjectType slidingBox(double side, double mass, double friction) {
    ObjectType type = boxType(side, mass);
    type.surface = {friction, 0};
    return type;
}

/// A box thrown along a wall and at it: the wall takes its speed aside, and so much of that along it as friction says.
TEST(Friction, WallSlowsWhatSlidesAlongIt) {
    for (const double box : {0.1, 0.4})
        for (const double wall : {0.0, 0.1, 0.4}) {
            SmallWorld world(walledField(40, 4, {wall, 0}));
            world.parts().scene.environment.floor = {0, 0, 0};
            world.object(slidingBox(0.3, 2, box), {2, 3.8, 0}, {2, 0.2, 0});
            const Scenario scenario = world.scenario();
            WorldState state = scenario.initialState();
            run(scenario, state, 100);
            EXPECT_NEAR(state.objects[0].velocity_W.y, 0, 1e-3);
            EXPECT_NEAR(state.objects[0].velocity_W.x, 2 - std::sqrt(box * wall) * 0.2, 2e-3) << box << ' ' << wall;
        }
}

/// The same on a slab that is free to move: what one loses the other has.
TEST(Friction, BodySlowsWhatSlidesAlongIt) {
    SmallWorld world;
    world.parts().scene.environment.floor = {0, 0, 0};
    world.object(slidingBox(0.3, 2, 0.1), {-0.7, 1.2, 0}, {2, -0.2, 0});
    world.object(slidingBox(2, 200, 0.4), {0, 0, 0});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 40);
    const double pressed = 0.2 / (1 / 2.0 + 1 / 200.0), rubbed = 0.2 * pressed;
    EXPECT_NEAR(state.objects[0].velocity_W.x, 2 - rubbed / 2, 5e-3);
    EXPECT_NEAR(state.objects[1].velocity_W.x, rubbed / 200, 5e-4);
    EXPECT_NEAR(state.objects[1].velocity_W.y, -pressed / 200, 5e-4);
}

/// A robot pushes a box over the floor: it slides on alone when the robot stops, as far as floor friction lets it.
TEST(Friction, PushedBoxSlidesOnByFloorFrictionAlone) {
    for (const double friction : {0.1, 0.3}) {
        SmallWorld world;
        world.parts().scene.environment.floor.slidingFriction = friction;
        const std::vector<StampedCommand> orders{{0, {0.5, 0}}, {2 * nanosecondsPerSecond, {}}};
        world.robot(squareRobot(), {0, 0, 0}, std::make_shared<const Told>(orders), ideal());
        world.object(boxType(0.3, 2), {0.6, 0, 0});
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState();
        run(scenario, state, 100);
        const Twist pushed = state.objects[0].velocity_W;
        EXPECT_NEAR(pushed.x, 0.5, friction * gravity * 0.02 + 1e-3) << "it goes with the robot";
        const double from = state.objects[0].pose.x;
        run(scenario, state, 100);
        EXPECT_EQ(state.objects[0].velocity_W, Twist{});
        EXPECT_NEAR(state.objects[0].pose.x - from, 0.25 / (2 * friction * gravity), 0.012);
    }
}

/// The floor slows a body down as much while it leans on something: a box and a ball along a smooth wall, thrown a
/// little at it.
TEST(Friction, FloorActsInTouchToo) {
    SmallWorld world(walledField(40, 4, {0, 0}));
    ObjectType ball = ballType();
    ball.surface = {0, 0};
    world.object(slidingBox(0.3, 2, 0), {2, 3.849, 0}, {3, 0.05, 0}).object(ball, {20, 3.889, 0}, {1.5, 0.3, 0});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    std::size_t touches = 0;
    for (int k = 0; k < 300; ++k) {
        StepTrace trace;
        step(scenario, state, buffers, {}, &trace);
        touches += trace.contacts.size();
    }
    EXPECT_GT(touches, 50u);
    EXPECT_NEAR(state.objects[0].pose.x - 2, 9 / (2 * 0.3 * gravity), 0.01);
    // The ball's spin towards the wall must be rubbed off before it rolls along it.
    const double slipping = 0.3 * ball.inertia / (0.3 * gravity);
    EXPECT_NEAR(state.objects[1].pose.x - 20, 1.5 * slipping + 2.25 / (2 * 0.4), 0.01);
}

/// The share by which friction with the floor varies is even from 1 - factor to 1 + factor, anew in every tick.
TEST(Friction, RandomFactorOnFloorFrictionIsEvenAndOfMeanOne) {
    const auto decelerations = [](double factor, std::uint64_t seed) {
        SmallWorld world;
        world.parts().scene.randomFactor = factor;
        ObjectType box = boxType();
        world.object(box, {0, 0, 0}, {100, 0, 0}).object(ballType(), {0, 9, 0}, {100, 0, 0});
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState(seed);
        std::array<std::vector<double>, 2> shares;
        const FloorSurface& floor = scenario.scene().environment.floor;
        const double full[] = {floor.slidingFriction * gravity * 0.02, floor.rollingDeceleration * 0.02};
        for (int k = 0; k < 1500; ++k) {
            const WorldState before = state;
            run(scenario, state, 1);
            for (std::size_t i = 0; i < 2; ++i)
                shares[i].push_back((before.objects[i].velocity_W.x - state.objects[i].velocity_W.x) / full[i]);
        }
        return shares;
    };
    for (const std::vector<double>& shares : decelerations(0.4, 3)) {
        const auto count = static_cast<double>(shares.size());
        double mean = 0, variance = 0;
        for (const double s : shares) mean += s / count;
        for (const double s : shares) variance += (s - mean) * (s - mean) / count;
        const double deviation = 0.4 / std::sqrt(3.0);
        EXPECT_NEAR(mean, 1, 4 * deviation / std::sqrt(count));
        EXPECT_NEAR(std::sqrt(variance), deviation, 4 * deviation / std::sqrt(5 * count));
        // Each tenth of the range has its tenth of the draws.
        std::array<int, 10> bins{};
        for (const double s : shares) {
            ASSERT_TRUE(s > 0.6 - 1e-9 && s < 1.4 + 1e-9) << s;
            ++bins[static_cast<std::size_t>(std::clamp((s - 0.6) / 0.08, 0.0, 9.999))];
        }
        for (const int bin : bins) EXPECT_NEAR(bin, count / 10, 5 * std::sqrt(count / 10));
    }
    const auto even = decelerations(0, 3), other = decelerations(0, 4);
    EXPECT_EQ(even, other) << "without the factor no seed matters";
    for (const std::vector<double>& shares : even)
        for (const double s : shares) ASSERT_NEAR(s, 1, 1e-9);
}

}  // namespace
}  // namespace mrose
