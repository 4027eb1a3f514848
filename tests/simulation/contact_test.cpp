// Touch: laws of collision against closed forms, and what must never happen.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/small_world.h"
#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

ObjectType smoothBall(double restitution) {
    ObjectType type = ballType();
    type.surface = {0, restitution};
    return type;
}

Environment frictionless(Environment environment) {
    environment.floor.slidingFriction = environment.floor.rollingDeceleration = 0;
    return environment;
}

TEST(Contact, BallBouncesOffAWallWithItsRestitution) {
    for (const double restitution : {0.0, 0.5, 0.8, 1.0}) {
        SmallWorld world(frictionless(walledField(4, 4, {0, 0})));
        world.object(smoothBall(restitution), {3, 2, 0}, {2, 0.5, 0});
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState();
        run(scenario, state, 35);
        EXPECT_NEAR(state.objects[0].velocity_W.x, restitution == 0 ? 0 : -2 * restitution, 1e-4) << restitution;
        EXPECT_NEAR(state.objects[0].velocity_W.y, 0.5, 1e-4);
        EXPECT_LE(state.objects[0].pose.x, 4 - 0.11 + 0.002);
    }
}

TEST(Contact, BallsExchangeMomentumByTheirRestitution) {
    for (const double restitution : {0.0, 0.6, 1.0}) {
        ObjectType heavy = smoothBall(restitution), light = smoothBall(restitution);
        heavy.mass = 1.5;
        light.mass = 0.5;
        SmallWorld world(frictionless({}));
        world.object(heavy, {0, 0, 0}, {1.0, 0, 0}).object(light, {1, 0, 0}, {-0.5, 0, 0});
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState();
        run(scenario, state, 40);
        const double v1 = state.objects[0].velocity_W.x, v2 = state.objects[1].velocity_W.x;
        EXPECT_NEAR(1.5 * v1 + 0.5 * v2, 1.5 * 1.0 - 0.5 * 0.5, 1e-4);
        EXPECT_NEAR(v2 - v1, restitution * 1.5, 1e-4) << restitution;
    }
}

TEST(Contact, PushedBoxRestsWithinTwoMillimetresOfTheWall) {
    SmallWorld world(walledField(4, 4));
    world.robot(squareRobot(), {2, 2, 0}, std::make_shared<const Told>(Command{0.4, 0}), ideal());
    world.object(boxType(0.3), {3, 2, 0});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 500);
    EXPECT_NEAR(4 - (state.objects[0].pose.x + 0.15), 0, 0.002);
    EXPECT_NEAR(state.objects[0].pose.x - 0.15 - (state.robots[0].pose.x + 0.225), 0, 0.002);
    // And rests: nothing trembles, nothing creeps out of the skin.
    for (int i = 0; i < 1000; ++i) {
        const Pose before = state.objects[0].pose;
        run(scenario, state, 1);
        ASSERT_NEAR(state.objects[0].pose.x, before.x, 2e-4);
        ASSERT_NEAR(state.objects[0].pose.y, before.y, 2e-4);
        ASSERT_NEAR(4 - (state.objects[0].pose.x + 0.15), 0, 0.002);
    }
}

/// An hour to the bit: nobody pushes it.
TEST(Contact, BoxThatRestsAtTheWallStaysWhereItIs) {
    SmallWorld world(walledField(4, 4));
    world.object(boxType(0.3), {3.7, 2, 0.05}, {1, 0, 0});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 500);
    const Pose start = state.objects[0].pose;
    EXPECT_GT(start.x, 3.7) << "it came to rest at the wall";
    run(scenario, state, 3600 * 50);
    EXPECT_EQ(state.objects[0].pose, start);
}

TEST(Contact, RobotFeelsTheWallInTheVelocityThatItsModelSeesNext) {
    SmallWorld world(walledField(4, 4));
    world.robot(squareRobot(), {3, 2, 0}, std::make_shared<const Told>(Command{0.5, 0}), paperFormModel());
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 200);
    ASSERT_EQ(state.robots[0].nextControl, 200);
    EXPECT_NEAR(state.robots[0].velocity_B.x, 0, 0.02);
    StepTrace trace;
    const WorldState next = stepped(scenario, state, {}, &trace);
    // Asked for 0.5 m/s with the lag of the model from a standing start.
    const double approach = 1 - std::exp(-1.0);
    EXPECT_NEAR(trace.robots[0].predicted.velocity.v, 0.5 * approach + state.robots[0].velocity_B.x * (1 - approach),
                1e-4);
    EXPECT_TRUE(trace.robots[0].touched);
    ASSERT_FALSE(trace.contacts.empty());
    EXPECT_EQ(trace.contacts[0].bodyA, 0u);
    EXPECT_EQ(trace.contacts[0].bodyB, noBody);
    EXPECT_NEAR(trace.contacts[0].normal.x, 1, 1e-5);
    EXPECT_NEAR(trace.contacts[0].position.x, 4, 0.01);
    EXPECT_GT(trace.contacts[0].impulse, 0);
}

/// Kinetic energy, spin about both axes included, J.
double energy(const Scenario& scenario, const WorldState& state) {
    double sum = 0;
    for (std::size_t i = 0; i < state.objects.size(); ++i) {
        const ObjectState& o = state.objects[i];
        const auto& body = scenario.contactType(state.robots.size() + i);
        const double v2 = o.velocity_W.x * o.velocity_W.x + o.velocity_W.y * o.velocity_W.y;
        sum += body.mass * v2 / 2 + body.inertia * o.velocity_W.rotation * o.velocity_W.rotation / 2;
        if (scenario.scene().typeOfObject(i).rolls)
            sum += scenario.scene().typeOfObject(i).inertia * body.mass * dot(o.roll_W, o.roll_W) / 2;
    }
    return sum;
}

TEST(Contact, FreeBodiesNeverGainEnergy) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        SmallWorld world(walledField(3, 3));
        world.parts().scene.randomFactor = 0.5;
        const auto draw = [&](std::int64_t i, std::uint32_t c) { return 2 * uniformNoise({seed, i, 0, c}) - 1; };
        for (std::int64_t i = 0; i < 16; ++i) {
            const Pose start{0.6 + 0.6 * static_cast<double>(i % 4), 0.6 + 0.6 * static_cast<double>(i / 4),
                             pi * draw(i, 0)};
            world.object(i % 2 == 0 ? ballType() : boxType(0.3), start, {4 * draw(i, 1), 4 * draw(i, 2), 0});
        }
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState(seed);
        double before = energy(scenario, state);
        for (int k = 0; k < 600; ++k) {
            run(scenario, state, 1);
            const double now = energy(scenario, state);
            ASSERT_LE(now, before + 1e-6 * (1 + before)) << "seed " << seed << ", tick " << k;
            before = now;
        }
    }
}

TEST(Contact, FastBallsGoNeitherThroughWallsNorThroughRobots) {
    for (std::int64_t trial = 0; trial < 300; ++trial) {
        const auto draw = [&](std::uint32_t c) { return 2 * uniformNoise({5, trial, 0, c}) - 1; };
        SmallWorld world(walledField(6, 3));
        // A row of robots from wall to wall, nearer to one another than a ball is wide.
        for (int i = 0; i < 6; ++i)
            world.robot(i % 2 == 0 ? squareRobot() : discRobot(), {3 + 0.05 * draw(10), 0.25 + 0.5 * i, 0},
                        std::make_shared<const Told>(Command{0, 0}), ideal());
        const double angle = 0.9 * draw(0);
        world.object(ballType(), {1 + draw(1), 1.5 + draw(2), 0}, {6 * std::cos(angle), 6 * std::sin(angle), 0});
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState();
        for (int k = 0; k < 100; ++k) {
            run(scenario, state, 1);
            const Pose& ball = state.objects[0].pose;
            ASSERT_LT(ball.x, 3) << trial << ", tick " << k;
            ASSERT_GT(ball.x, 0.1) << trial;
            ASSERT_TRUE(ball.y > 0.1 && ball.y < 2.9) << trial;
        }
    }
}

/// The deepest overlap of one of the first `bodies` bodies with another of them or with a wall, m.
double deepestOverlap(const Scenario& scenario, const WorldState& state, std::size_t bodies) {
    double deepest = 0;
    for (std::size_t a = 0; a < bodies; ++a)
        for (const ConvexPiece& x : scenario.scene().shapeOf(a).pieces) {
            const ConvexPiece own = placed(x, Placement(Scenario::poseOf(state, a)));
            for (const ConvexPiece& wall : scenario.obstacles().pieces())
                deepest = std::max(deepest, -distance(own, wall));
            for (std::size_t b = a + 1; b < bodies; ++b)
                for (const ConvexPiece& y : scenario.scene().shapeOf(b).pieces)
                    deepest = std::max(deepest, -distance(own, placed(y, Placement(Scenario::poseOf(state, b)))));
        }
    return deepest;
}

TEST(Contact, RobotsCannotBePushedThroughWallsOrOneAnother) {
    // Twelve robots push towards one corner for a minute.
    SmallWorld world(walledField(6, 6));
    for (int i = 0; i < 12; ++i)
        world.robot(i % 2 == 0 ? squareRobot() : discRobot(), {1.0 + 0.6 * (i % 4), 1.0 + 0.6 * (i / 4), -0.75 * pi},
                    std::make_shared<const Told>(Command{1, 0.05 * (i % 3 - 1)}), ideal());
    world.object(ballType(), {0.5, 0.5, 0});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    double robots = 0, all = 0;
    for (int k = 0; k < 3000; ++k) {
        run(scenario, state, 1);
        if (k % 10 != 0) continue;
        robots = std::max(robots, deepestOverlap(scenario, state, 12));
        all = std::max(all, deepestOverlap(scenario, state, 13));
    }
    EXPECT_LT(robots, 0.01);
    // The ball, a fiftieth of a robot's mass, is pressed into the corner by all of them.
    EXPECT_LT(all, 0.05);
    for (const RobotState& robot : state.robots) EXPECT_TRUE(robot.pose.x > 0.1 && robot.pose.y > 0.1);
    EXPECT_TRUE(state.objects[0].pose.x > 0.05 && state.objects[0].pose.y > 0.05);
}

TEST(Contact, RandomFactorVariesBouncesOnlyWhenAsked) {
    const auto bounced = [](double factor) {
        std::vector<double> speeds;
        for (std::uint64_t seed = 1; seed <= 40; ++seed) {
            SmallWorld world(frictionless(walledField(4, 4, {0, 0})));
            world.parts().scene.randomFactor = factor;
            world.object(smoothBall(0.5), {3.5, 2, 0}, {2, 0, 0});
            const Scenario scenario = world.scenario();
            WorldState state = scenario.initialState(seed);
            run(scenario, state, 30);
            speeds.push_back(-state.objects[0].velocity_W.x);
        }
        std::sort(speeds.begin(), speeds.end());
        return speeds;
    };
    const std::vector<double> same = bounced(0), varied = bounced(0.4);
    EXPECT_EQ(same.front(), same.back());
    EXPECT_LT(varied.front(), 2 * 0.5 * 0.75);
    EXPECT_GT(varied.back(), 2 * 0.5 * 1.25);
    EXPECT_GE(varied.front(), 2 * 0.5 * 0.6 - 1e-3);
    EXPECT_LE(varied.back(), 2 * 0.5 * 1.4 + 1e-3);
}

}  // namespace
}  // namespace mrose
