#include <cmath>

#include <gtest/gtest.h>

#include "simulation/small_world.h"
#include "support/units.h"

namespace mrose {
namespace {

/// Stands, and kicks with the given power at every control instant.
class Kicker final : public Controller {
public:
    explicit Kicker(double power = 1, std::uint32_t manipulator = 0) : kick_{manipulator, power} {}
    void decide(const Observation& /*observation*/, std::span<std::byte> /*memory*/,
                Decision& decision) const override {
        decision.kicks.push_back(kick_);
    }

private:
    Kick kick_;
};

RobotType kickingRobot() {
    RobotType type = squareRobot();
    Manipulator kicker;
    kicker.name = "kicker";
    kicker.position = {0.225, 0};
    kicker.speed = 3;
    kicker.reach = 0.05;
    kicker.width = 0.2;
    kicker.recharge = 1000 * ms;
    kicker.deadTime = 130 * ms;
    type.manipulators = {kicker};
    return type;
}

Scenario withBallAt(const Pose& ball, const RobotType& robot = kickingRobot(),
                    std::shared_ptr<const Controller> controller = std::make_shared<const Kicker>()) {
    SmallWorld world;
    world.robot(robot, {1, 1, 0.5}, std::move(controller), ideal());
    world.object(ballType(), Pose{1, 1, 0.5} * ball);
    return world.scenario();
}

/// The tick after which the ball first moves, or -1.
int firstMoved(const Scenario& scenario, WorldState& state, int ticks) {
    for (int k = 0; k < ticks; ++k) {
        run(scenario, state, 1);
        if (state.objects[0].velocity_W.x != 0) return k;
    }
    return -1;
}

TEST(Kick, GoesThroughTheDeadTimeAndGivesItsSpeedAlongItsDirection) {
    const Scenario scenario = withBallAt({0.225 + 0.11 + 0.02, 0.03, 0});
    WorldState state = scenario.initialState();
    EXPECT_EQ(firstMoved(scenario, state, 20), 6);  // 130 ms fall into the tick from 120 to 140 ms
    const Twist& v = state.objects[0].velocity_W;
    const double slowed = 0.3 * 9.81 * 0.02;
    EXPECT_NEAR(std::hypot(v.x, v.y), 3 - slowed, 1e-9);
    EXPECT_NEAR(std::atan2(v.y, v.x), 0.5, 1e-9);
}

TEST(Kick, RechargesBeforeItActsAgain) {
    const Scenario scenario = withBallAt({5, 0, 0});
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    std::vector<std::int64_t> acted;
    for (int k = 0; k < 150; ++k) {
        StepTrace trace;
        step(scenario, state, buffers, {}, &trace);
        for (const StepTrace::Kicked& kicked : trace.kicks) {
            EXPECT_FALSE(kicked.hit);
            acted.push_back(k);
        }
    }
    // Commanded at 0, 100 ms ...: it acts at 130 ms, and next by the first command that arrives a second later.
    EXPECT_EQ(acted, (std::vector<std::int64_t>{6, 56, 106}));
}

TEST(Kick, ReachesOnlyWhatLiesBeforeItsFace) {
    const double touching = 0.225 + 0.11;
    for (const auto& [ball, hit] : std::vector<std::pair<Pose, bool>>{{{touching + 0.049, 0, 0}, true},
                                                                      {{touching + 0.051, 0, 0}, false},
                                                                      {{touching + 0.01, 0.099, 0}, true},
                                                                      {{touching + 0.01, 0.101, 0}, false},
                                                                      {{-touching - 0.01, 0, 0}, false}}) {
        const Scenario scenario = withBallAt(ball);
        WorldState state = scenario.initialState();
        EXPECT_EQ(firstMoved(scenario, state, 20) >= 0, hit) << ball.x << ' ' << ball.y;
    }
}

TEST(Kick, PowerScalesTheSpeedAndTheRobotsOwnMotionAddsToIt) {
    const Scenario half = withBallAt({0.36, 0, 0}, kickingRobot(), std::make_shared<const Kicker>(0.5));
    WorldState state = half.initialState();
    ASSERT_GE(firstMoved(half, state, 20), 0);
    EXPECT_NEAR(std::hypot(state.objects[0].velocity_W.x, state.objects[0].velocity_W.y), 1.5 - 0.3 * 9.81 * 0.02,
                1e-9);
}

TEST(Kick, OrdersThatMakeNoSenseAreFaultsOfTheirController) {
    for (const auto& [kicker, cause] : std::vector<std::pair<Kicker, const char*>>{
             {Kicker(1.5), "its controller gave a kick whose power is not in 0 ... 1"},
             {Kicker(std::nan("")), "its controller gave a kick whose power is not in 0 ... 1"},
             {Kicker(1, 1), "its controller kicked with a manipulator that it does not have"}}) {
        const Scenario scenario = withBallAt({0.36, 0, 0}, kickingRobot(), std::make_shared<const Kicker>(kicker));
        StepTrace trace;
        const WorldState state = stepped(scenario, scenario.initialState(), {}, &trace);
        ASSERT_EQ(trace.faults.size(), 1u);
        EXPECT_EQ(trace.faults[0].what, cause);
        EXPECT_TRUE(state.kicks.empty());
    }
}

}  // namespace
}  // namespace mrose
