#include "synthetic/reference_ball.h"

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "behaviour/command_player.h"
#include "scene/floor_motion.h"
#include "simulation/small_world.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

constexpr double tick = 0.02;  // s

/// Without anything but what a test asks for.
ReferenceBallParameters plainBall() {
    return {.perSpeed = 0, .grain = 0, .patches = 0, .drift = 0, .bumps = 0, .eccentricity = 0};
}

FloorSurface floorOf(double sliding, double rolling) { return {sliding, 0.6, rolling, {}, {}}; }

/// A ball driven by itself, tick by tick.
class Rolled {
public:
    Rolled(const ReferenceBallParameters& parameters, const FloorSurface& floor, const ObjectState& start,
           std::uint64_t seed = 1)
        : model_(parameters), floor_(floor), ball(start), seed_(seed) {}

    void go(double seconds, double step = tick) {
        for (double t = 0; t < seconds - step / 2; t += step) {
            const NoiseKey key{seed_, tick_++, 0, 0};
            ball = model_.after({ball, type_, floor_, 0, step, key,
                                 std::as_writable_bytes(std::span<ReferenceBall::Memory>(&memory, 1))});
        }
    }
    double speed() const { return std::hypot(ball.velocity_W.x, ball.velocity_W.y); }

private:
    ReferenceBall model_;
    FloorSurface floor_;
    ObjectType type_ = ballType();
    std::int64_t tick_ = 0;

public:
    ObjectState ball;
    ReferenceBall::Memory memory;

private:
    std::uint64_t seed_;
};

ObjectState rolling(double vx, double vy) { return {{}, {vx, vy, 0}, {vx, vy}}; }

/// dv/dt = -c (a + b v): in closed form.
TEST(ReferenceBall, IsSlowedDownMoreTheFasterItRolls) {
    ReferenceBallParameters parameters = plainBall();
    parameters.perSpeed = 0.25;
    const double c = 0.4, a = parameters.atRest, b = parameters.perSpeed, t = 1.5;
    Rolled rolled(parameters, floorOf(0.3, c), rolling(1.2, -0.9));
    rolled.go(t);
    const double expected = (1.5 + a / b) * std::exp(-c * b * t) - a / b;
    EXPECT_NEAR(rolled.speed(), expected, 2e-3);
    const double way = ((1.5 - expected) - c * a * t) / (c * b);
    EXPECT_NEAR(std::hypot(rolled.ball.pose.x, rolled.ball.pose.y), way, 3e-3);
    EXPECT_NEAR(rolled.ball.pose.y / rolled.ball.pose.x, -0.75, 1e-9);
}

/// m v + (I / r2) u is what friction at the touching point cannot change; it never rolls quite without slip.
TEST(ReferenceBall, SlidesUntilItNearlyRolls) {
    Rolled kicked(plainBall(), floorOf(0.3, 0), {{}, {3, 0, 0}, {}});
    kicked.go(0.1);
    EXPECT_NEAR(kicked.ball.velocity_W.x + kicked.ball.roll_W.x * 2 / 3, 3, 1e-9);
    const ObjectState other = afterFloorMotion({{}, {3, 0, 0}, {}}, ballType(), floorOf(0.3, 0), 1, 0.1);
    EXPECT_GT(std::abs(other.velocity_W.x - kicked.ball.velocity_W.x), 0.01) << "it is of another class";
    kicked.go(2);
    EXPECT_NEAR(kicked.ball.velocity_W.x, 0.6 * 3, 1e-6);
    EXPECT_NEAR(kicked.ball.roll_W.x, 0.6 * 3, 1e-6);
    Rolled spun(plainBall(), floorOf(0.3, 0), {{}, {0.5, 0, 0}, {-2, 0}});
    spun.go(2);
    EXPECT_NEAR(spun.ball.velocity_W.x, (0.5 + 2.0 / 3 * -2) / (1 + 2.0 / 3), 1e-6) << "backspin brings it back";
}

TEST(ReferenceBall, HeavySideRollsWithIt) {
    const double around = 2 * std::numbers::pi * ballType().shape->reach;
    Rolled rolled(plainBall(), floorOf(0.3, 0), rolling(around / 2, 0));  // half a turn a second
    rolled.go(tick);
    const ReferenceBall::Memory before = rolled.memory;
    EXPECT_NEAR(std::hypot(before.heavyX, before.heavyY, before.heavyZ), 1, 1e-12);
    rolled.go(1);
    EXPECT_NEAR(rolled.memory.heavyX, -before.heavyX, 1e-9);
    EXPECT_NEAR(rolled.memory.heavyY, before.heavyY, 1e-9);
    EXPECT_NEAR(rolled.memory.heavyZ, -before.heavyZ, 1e-9);
    rolled.go(1);
    EXPECT_NEAR(rolled.memory.heavyX, before.heavyX, 1e-9);
    EXPECT_NEAR(rolled.memory.heavyZ, before.heavyZ, 1e-9);
}

/// What the heavy side's weight gives to the spin it takes from its height.
TEST(ReferenceBall, UnevenMassKeepsTheEnergy) {
    ReferenceBallParameters parameters = plainBall();
    parameters.eccentricity = 0.005;
    Rolled spun(parameters, floorOf(0, 0), {{}, {}, {0.6, 0.2}});
    const auto energy = [&] {
        const Point& u = spun.ball.roll_W;
        return dot(u, u) / 3 + parameters.eccentricity * gravity * spun.memory.heavyZ;
    };
    spun.go(tick);
    const double before = energy();
    double least = 1, most = 0;
    for (int i = 0; i < 100; ++i) {
        spun.go(tick);
        EXPECT_NEAR(energy(), before, 1e-3) << i;
        least = std::min(least, length(spun.ball.roll_W));
        most = std::max(most, length(spun.ball.roll_W));
    }
    EXPECT_GT(most, 1.05 * least) << "it wobbles";
}

TEST(ReferenceBall, GrainAndPatchesOfTheCarpetCount) {
    const ReferenceBall ball;
    const ReferenceBallParameters& p = ball.parameters();
    const Point pile = towards(p.grainDirection), nowhere{-0.7 / 2.3, 0};
    const auto slowed = [&](const Point& place, const Point& velocity) {
        return ball.rollingDeceleration(place, velocity, 0.4);
    };
    EXPECT_NEAR(slowed(nowhere, pile), 0.4 * (p.atRest + p.perSpeed) * (1 - p.grain), 1e-12);
    EXPECT_NEAR(slowed(nowhere, -1 * pile), 0.4 * (p.atRest + p.perSpeed) * (1 + p.grain), 1e-12);
    double least = 1, most = 0;
    for (double x = 0; x < 9; x += 0.1) {
        least = std::min(least, slowed({x, 1.2}, {0, 1e-9}));
        most = std::max(most, slowed({x, 1.2}, {0, 1e-9}));
    }
    EXPECT_GT(most / least, 1.15);
    Rolled rolled({}, floorOf(0.3, 0.4), rolling(1.2, 0));
    rolled.go(10);
    EXPECT_GT(rolled.ball.pose.x, 1.2);
    EXPECT_LT(rolled.ball.pose.x, 2.2);
    EXPECT_GT(std::abs(rolled.ball.pose.y), 0.01) << "it does not roll straight";
}

TEST(ReferenceBall, ComesToRestAndStays) {
    for (std::uint64_t seed = 1; seed < 20; ++seed) {
        Rolled rolled({}, floorOf(0.3, 0.4), {{0, 0, 0}, {1, 0.5, 4}, {-1, 0.3}}, seed);
        rolled.go(15);
        EXPECT_EQ(rolled.ball.velocity_W, Twist{}) << seed;
        EXPECT_EQ(rolled.ball.roll_W, Point{}) << seed;
        const Pose rest = rolled.ball.pose;
        rolled.go(1);
        EXPECT_EQ(rolled.ball.pose, rest);
    }
}

/// Contact cuts ticks in two.
TEST(ReferenceBall, DoesNotDependOnTheTick) {
    ReferenceBallParameters parameters;
    parameters.bumps = 0;
    const ObjectState start{{1, 2, 0}, {2, 1, 3}, {0.2, -0.4}};
    Rolled whole(parameters, floorOf(0.3, 0.4), start), halves = whole;
    whole.go(tick);
    halves.memory = whole.memory;
    whole = Rolled(parameters, floorOf(0.3, 0.4), start);
    whole.memory = halves.memory;
    whole.go(0.6);
    halves.go(0.6, tick / 2);
    EXPECT_NEAR(whole.ball.pose.x, halves.ball.pose.x, 1e-12);
    EXPECT_NEAR(whole.ball.pose.y, halves.ball.pose.y, 1e-12);
    EXPECT_NEAR(whole.ball.velocity_W.x, halves.ball.velocity_W.x, 1e-12);
    EXPECT_NEAR(whole.memory.heavyX, halves.memory.heavyX, 1e-12);
}

/// Two robots that drive about and push the ball in a small field.
Scenario pushedBall() {
    SmallWorld world(walledField(3, 2));
    const auto commands = std::make_shared<const RandomCommands>(-0.2, 1, 3);
    world.robot(discRobot(0.2), {0.6, 0.6, 0.3}, commands, ideal());
    world.robot(discRobot(0.2), {2.3, 1.4, -2}, commands, ideal(), 2);
    ObjectType ball = ballType();
    ball.motion = referenceBall();
    world.object(ball, {1.5, 1, 0}, {0.8, 0.3, 0});
    return world.scenario();
}

TEST(ReferenceBall, IsRewoundFromEveryTickToTheSameBits) {
    const Scenario scenario = pushedBall();
    WorldState state = scenario.initialState();
    std::vector<WorldState> kept;
    StepBuffers buffers;
    StepTrace trace;
    int touched = 0;
    for (int i = 0; i < 250; ++i) {
        kept.push_back(state);
        step(scenario, state, buffers, {}, &trace);
        touched += trace.touchedObjects[0];
    }
    EXPECT_GT(touched, 0) << "there was contact";
    for (const WorldState& from : kept) {
        WorldState again = from;
        run(scenario, again, static_cast<int>(state.tick - from.tick));
        ASSERT_EQ(stateBytes(again), stateBytes(state)) << from.tick;
    }
}

TEST(ReferenceBall, AnotherSeedIsAnotherBall) {
    SmallWorld world;
    ObjectType ball = ballType();
    ball.motion = referenceBall();
    world.object(ball, {}, {1, 0, 0}).object(ball, {0, 5, 0}, {1, 0, 0});
    const Scenario scenario = world.scenario();
    std::set<double> ways;
    for (const std::uint64_t seed : {1, 2, 1}) {
        WorldState state = scenario.initialState(seed);
        run(scenario, state, 100);
        for (const ObjectState& object : state.objects) ways.insert(object.pose.x);
    }
    EXPECT_EQ(ways.size(), 4u);
}

TEST(ReferenceBall, ExplainsWhatItRemembers) {
    const Scenario scenario = pushedBall();
    WorldState state = scenario.initialState();
    const ObjectModel& model = *scenario.scene().typeOfObject(0).motion;
    EXPECT_TRUE(explained(model, scenario.motionMemory(state, 2)).empty());
    run(scenario, state, 3);
    const auto entries = explained(model, scenario.motionMemory(state, 2));
    ASSERT_EQ(entries.size(), 4u);
    EXPECT_EQ(entries[0].text, "reference ball");
    EXPECT_NEAR(std::hypot(entries[1].value, entries[2].value, entries[3].value), 1, 1e-12);
}

}  // namespace
}  // namespace mrose
