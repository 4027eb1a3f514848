#include "condition/condition.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/small_world.h"

namespace mrose {
namespace {

Polygon square(double x, double y) { return {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}; }

/// Two robots that drive at each other, a person who stands, a ball that rolls, a box.
Scenario meeting() {
    Environment environment = walledField(10, 6);
    environment.goals = {{"left", square(0, 2)}, {"right", square(9, 2)}};
    RobotType kicker = squareRobot();
    kicker.manipulators.resize(1);
    RobotType person = discRobot();
    person.person = true;
    SmallWorld world(environment);
    world.robot(kicker, {2, 3, 0}, std::make_shared<Told>(Command{0.6, 0.1}), ideal())
        .robot(squareRobot(), {3.5, 3, std::numbers::pi}, std::make_shared<Told>(Command{0.4, 0}), ideal())
        .robot(person, {7, 5, 7}, std::make_shared<Told>(Command{}), ideal())
        .object(boxType(), {8, 1, 0})
        .object(ballType(), {5, 1, 0}, {-1, 0.2, 0});
    ScenarioParts& parts = world.parts();
    parts.seed = 12;
    parts.scene.robots[0].name = "keeper";
    parts.scene.robots[1].name = "red 2";
    parts.scene.robots[2].name = "Anna";
    parts.scene.objects[1].name = "football";
    return world.scenario();
}

class Conditions : public testing::Test {
protected:
    Conditions() : scenario_(meeting()), state_(scenario_.initialState()) {}

    bool holds(const std::string& text) {
        auto condition = compileCondition(text, scenario_, "condition", real_);
        EXPECT_TRUE(condition) << text << ": " << condition.error().message();
        if (!condition) return false;
        const auto answer = condition->holds(moment());
        EXPECT_TRUE(answer) << text << ": " << answer.error().message();
        return answer && *answer;
    }
    /// Exactly this number, by reading its shortest text back.
    void expectNumber(const std::string& text, double value) {
        char exact[40];
        std::snprintf(exact, sizeof exact, "%.17g", value);
        EXPECT_TRUE(holds(text + " == " + exact)) << text << " is not " << exact;
    }
    std::string refusal(const std::string& text) {
        const auto condition = compileCondition(text, scenario_, "--until");
        EXPECT_FALSE(condition) << text;
        return condition ? "" : condition.error().message();
    }
    void runTicks(int ticks) {
        for (int i = 0; i < ticks; ++i) step(scenario_, state_, buffers_, {}, &trace_);
    }
    void runUntil(const std::string& text) {
        auto condition = compileCondition(text, scenario_);
        ASSERT_TRUE(condition) << condition.error().message();
        do runTicks(1);
        while (state_.tick < 500 && !*condition->holds(moment()));
        ASSERT_LT(state_.tick, 500) << text;
    }

    Moment moment() const { return {&scenario_, &state_, &trace_, {}, real_}; }

    Scenario scenario_;
    WorldState state_;
    StepBuffers buffers_;
    StepTrace trace_;
    const RealRobots* real_ = nullptr;
};

TEST_F(Conditions, ReadTheState) {
    runTicks(37);
    const RobotState& keeper = state_.robots[0];
    for (const std::string name : {"robot[1]", "robot.keeper", "robot['keeper']"}) {
        expectNumber(name + ".x", keeper.pose.x);
        expectNumber(name + ".y", keeper.pose.y);
        expectNumber(name + ".heading", keeper.pose.heading);
        expectNumber(name + ".v", keeper.velocity_B.x);
        expectNumber(name + ".w", keeper.velocity_B.rotation);
        expectNumber(name + ".speed", std::hypot(keeper.velocity_B.x, keeper.velocity_B.y));
        expectNumber(name + ".command_v", 0.6);
        expectNumber(name + ".command_w", 0.1);
    }
    expectNumber("robot['red 2'].x", state_.robots[1].pose.x);
    expectNumber("person[1].x", state_.robots[2].pose.x);
    expectNumber("person.Anna.heading", wrapAngle(7));
    const ObjectState& ball = state_.objects[1];
    for (const std::string name : {"ball", "object[2]", "object.football"}) {
        expectNumber(name + ".x", ball.pose.x);
        expectNumber(name + ".y", ball.pose.y);
        expectNumber(name + ".vx", ball.velocity_W.x);
        expectNumber(name + ".vy", ball.velocity_W.y);
        expectNumber(name + ".speed", std::hypot(ball.velocity_W.x, ball.velocity_W.y));
    }
    expectNumber("object[1].x", 8);
    expectNumber("tick", 37);
    expectNumber("time", 37 * 0.02);
    expectNumber("seed", 12);
    EXPECT_TRUE(holds("#robot == 2 and #person == 1 and #object == 2 and #goals == 2"));
    EXPECT_TRUE(holds("ball == object[2] and robot[1] ~= robot[2]"));
}

TEST_F(Conditions, MeasureBetweenBodies) {
    expectNumber("distance(robot[1], ball)", std::hypot(3, 2));
    expectNumber("distance(ball, person.Anna)", std::hypot(2, 4));
    EXPECT_TRUE(holds("abs(bearing(robot[1], ball) - atan(-2, 3)) < 1e-12"));
    // Robot 2 looks along -x: the ball lies behind its left side.
    EXPECT_TRUE(
        holds("abs(bearing(robot[2], ball) - wrap(atan(-2, 1.5) - pi)) < 1e-12 and bearing(robot[2], ball) > 0"));
    expectNumber("wrap(7)", wrapAngle(7));
}

TEST_F(Conditions, CountGoals) {
    state_.goals = {3, 1};
    EXPECT_TRUE(holds("goals.left == 3 and goals[2] == 1 and goals['right'] == 1 and goals[1] == 3"));
}

TEST_F(Conditions, SeeWhoTouchesWhat) {
    EXPECT_FALSE(holds("robot[1].touching or ball.touching or touching(robot[1], robot[2])"));
    runUntil("robot[1].touching");
    EXPECT_FALSE(trace_.contacts.empty());
    EXPECT_TRUE(holds("touching(robot[1], robot[2]) and touching(robot[2], robot[1])"));
    EXPECT_TRUE(holds("robot[1].touching and robot[2].touching and not person[1].touching and not ball.touching"));
    EXPECT_FALSE(holds("touching(robot[1], wall) or touching(wall, robot[2]) or touching(wall, wall)"));
    EXPECT_FALSE(holds("touching(robot[1], robot[1])"));
}

/// A ball that bounces off within the tick touched the wall all the same.
TEST_F(Conditions, SeeABounce) {
    state_.objects[1] = {{5, 0.2, 0}, {0, -4, 0}, {0, -4}};
    runUntil("touching(ball, wall)");
    EXPECT_GT(state_.objects[1].velocity_W.y, 0);
    EXPECT_TRUE(holds("ball.touching and touching(wall, object.football)"));
    runTicks(1);
    EXPECT_FALSE(holds("ball.touching"));
}

/// In the tick of the kick, and in no other.
TEST_F(Conditions, SeeKicks) {
    state_.kicks = {{250'000'000, 0, 0, 1.0}};
    for (int i = 1; i <= 30; ++i) {
        runTicks(1);
        EXPECT_EQ(holds("robot.keeper.kicked"), i == 13) << i;
        EXPECT_FALSE(holds("robot[2].kicked"));
    }
}

TEST_F(Conditions, TakeFunctionsForCounting) {
    EXPECT_TRUE(
        holds("(function() local n = 0 for i = 1, #robot do if robot[i].x > 1 then n = n + 1 end end "
              "return n == 2 end)()"));
}

TEST_F(Conditions, FollowTheStateFromTickToTick) {
    auto condition = compileCondition("robot[1].x > 2.2 and time < 0.5", scenario_);
    ASSERT_TRUE(condition);
    EXPECT_EQ(condition->text(), "robot[1].x > 2.2 and time < 0.5");
    const WorldState start = state_;
    bool seen = false;
    for (int i = 0; i < 40; ++i) {
        runTicks(1);
        const bool expected = state_.robots[0].pose.x > 2.2 && static_cast<double>(state_.tick) * 0.02 < 0.5;
        EXPECT_EQ(*condition->holds(moment()), expected) << state_.tick;
        seen = seen || expected;
    }
    EXPECT_TRUE(seen);
    EXPECT_FALSE(*condition->holds({&scenario_, &start}));
    Condition moved = std::move(*condition);
    EXPECT_FALSE(*moved.holds({&scenario_, &start}));
}

/// A real robot beside the keeper that stood up to 0.5 s, and was seen no longer.
class Standing final : public RealRobots {
public:
    std::optional<Pose> poseOf(const std::string& robot, Nanoseconds now) const override {
        if (robot != "keeper" || now > 500'000'000) return {};
        return Pose{2, 3, 7};
    }
};

TEST_F(Conditions, KnowTheErrorToTheRealRobotAsLongAsItIsKnown) {
    const Standing standing;
    real_ = &standing;
    runTicks(20);
    const Pose& keeper = state_.robots[0].pose;
    ASSERT_GT(keeper.x, 2.05);
    EXPECT_TRUE(holds("robot.keeper.real_x == 2 and robot[1].real_y == 3"));
    expectNumber("robot.keeper.real_heading", wrapAngle(7));
    expectNumber("robot.keeper.error", std::hypot(keeper.x - 2, keeper.y - 3));
    expectNumber("robot.keeper.heading_error", std::abs(wrapAngle(keeper.heading - 7)));
    const std::string never = ".error >= 0 or robot[NUMBER].error < 0 or robot[NUMBER].real_x == robot[NUMBER].real_x";
    const auto known = [&](const std::string& number) {
        std::string text = "robot[NUMBER]" + never;
        for (auto at = text.find("NUMBER"); at != std::string::npos; at = text.find("NUMBER"))
            text.replace(at, 6, number);
        return holds(text);
    };
    EXPECT_TRUE(known("1"));
    EXPECT_FALSE(known("2")) << "none really drove beside it";
    runTicks(5);
    EXPECT_TRUE(known("1")) << "0.5 s";
    runTicks(1);
    EXPECT_FALSE(known("1"));
    EXPECT_TRUE(holds("not (robot[1].error < 100)"));
}

TEST_F(Conditions, SayThatThereIsNoRealLog) {
    for (const std::string name : {"error", "heading_error", "real_x", "real_y", "real_heading"})
        EXPECT_EQ(refusal("time > 1 and robot[1]." + name + " > 0"),
                  "--until:1:23: '" + name + "' needs a real log beside the run: none is open");
    EXPECT_THAT(refusal("person[1].error > 1"),
                testing::StartsWith("--until:1:11: there is no 'error': a person has measured_error, "));
    EXPECT_EQ(refusal("(function() return robot[1].error > 1 end)()"),
              "--until:1: 'error' needs a real log beside the run: none is open");
}

TEST_F(Conditions, RefuseWhatTheSceneHasNot) {
    EXPECT_EQ(refusal("robot[9].x > 1"), "--until:1:7: there is no robot 9: there are 2 robots");
    EXPECT_EQ(refusal("robot[0].x > 1"), "--until:1:7: there is no robot 0: there are 2 robots");
    EXPECT_EQ(refusal("robot[1.5].x > 1"), "--until:1:7: there is no robot 1.5: there are 2 robots");
    EXPECT_EQ(refusal("person.Bert.x > 1"), "--until:1:8: there is no person 'Bert': there is 1 person, called 'Anna'");
    EXPECT_EQ(refusal("goals.middle > 1"),
              "--until:1:7: there is no goal 'middle': there are 2 goals, called 'left', 'right'");
    EXPECT_EQ(refusal("object[true].x > 1"), "--until:1: there is no object true: there are 2 objects");
    EXPECT_THAT(refusal("robot[1].sped > 1"),
                testing::StartsWith("--until:1:10: there is no 'sped': a robot has speed, "));
    EXPECT_EQ(refusal("robot[1].odometry.vv > 1"),
              "--until:1:19: there is no 'vv' in 'odometry': it has 'v', 'w', 'records'");
    EXPECT_THAT(refusal("robot[1].sight.robotz > 1"),
                testing::EndsWith("there is no 'robotz' in 'sight': it has 'robots', 'objects'"));
    EXPECT_TRUE(compileCondition("robot[1].odometry.v > 1", scenario_, "--until"));
    // The nearest first, and no more than a line.
    EXPECT_EQ(refusal("ball.v > 1"),
              "--until:1:6: there is no 'v': an object has x, y, heading, speed, vx, vy, w, direction, slip, touching, "
              "impulse");
    EXPECT_EQ(refusal("time > 1 and velocity > 2"), "--until:1:14: unknown name 'velocity'");
    scenario_ = SmallWorld().robot(squareRobot(), {}, std::make_shared<Told>(Command{}), ideal()).scenario();
    EXPECT_EQ(refusal("ball.x > 1"), "--until:1:1: there is no ball: no object rolls");
    EXPECT_EQ(refusal("object[1].x > 1"), "--until:1:8: there is no object 1: there are no objects");
    EXPECT_EQ(refusal("robot[2].x > 1"), "--until:1:7: there is no robot 2: there is 1 robot");
}

/// Also where the start would not lead there.
TEST(LeftOutRobots, RefusalNamesTheNumbersThatAreThere) {
    const auto refused = [](const Scenario& scenario) {
        const auto condition = compileCondition("robot[1].x > 1", scenario);
        return condition ? "" : condition.error().cause;
    };
    ScenarioParts parts = meeting().parts();
    parts.scene.robots[0].place = 2;
    parts.scene.robots[1].place = 4;
    EXPECT_EQ(refused(Scenario(parts)), "there is no robot 1: there are robots 3, 5");
    parts.scene.robots.erase(parts.scene.robots.begin());
    parts.controllers.erase(parts.controllers.begin());
    EXPECT_EQ(refused(Scenario(parts)), "there is no robot 1: there is robot 5");
}

TEST_F(Conditions, RefuseItBehindAndAndOr) {
    EXPECT_EQ(refusal("time > 60 and\n robot[7].x > 1"), "--until:2:8: there is no robot 7: there are 2 robots");
    EXPECT_THAT(refusal("time < 60 or not ball.touch"),
                testing::StartsWith("--until:1:23: there is no 'touch': an object has touching, "));
}

TEST_F(Conditions, RefuseWhatIsNeitherTrueNorFalse) {
    EXPECT_EQ(refusal("time"), "--until: gives the number 0.0; expected true or false");
    EXPECT_EQ(refusal("'yes'"), "--until: gives a text; expected true or false");
    EXPECT_EQ(refusal("robot[1]"), "--until: gives a value of type robot; expected true or false");
    EXPECT_EQ(refusal("nil"), "--until: gives a value of type nil; expected true or false");
    // Only a later state leads there.
    auto condition = compileCondition("time < 0.1 or 5", scenario_);
    ASSERT_TRUE(condition);
    EXPECT_TRUE(*condition->holds(moment()));
    runTicks(5);
    const auto answer = condition->holds(moment());
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().message(), "condition: gives the number 5.0; expected true or false");
}

TEST_F(Conditions, RefuseWrongUses) {
    EXPECT_EQ(refusal("robot[1] > 3"), "--until:1: attempt to compare number with robot");
    EXPECT_EQ(refusal("robot > 3"), "--until:1: attempt to compare number with list of robots");
    EXPECT_EQ(refusal("distance(robot[1]) > 3"),
              "--until:1: bad argument #2 to 'distance' (expected a robot, a person or an object)");
    EXPECT_EQ(refusal("distance(robot[1], wall) > 3"),
              "--until:1: bad argument #2 to 'distance' (expected a robot, a person or an object)");
    EXPECT_EQ(refusal("distance(robot[1], robot) > 3"),
              "--until:1: bad argument #2 to 'distance' (expected a robot, a person or an object)");
    EXPECT_EQ(refusal("bearing(robot[1], 3) > 3"),
              "--until:1: bad argument #2 to 'bearing' (expected a robot, a person or an object)");
    EXPECT_EQ(refusal("touching(robot[1], goals)"),
              "--until:1: bad argument #2 to 'touching' (expected a robot, a person, an object or wall)");
    EXPECT_EQ(refusal("wall.x > 1"), "--until:1:6: attempt to index a wall value (global 'wall')");
    EXPECT_EQ(refusal("(function() robot[1] = robot[2] end)()"),
              "--until:1: attempt to index a list of robots value (global 'robot')");
    EXPECT_EQ(refusal("robot[1].x >"), "--until:1:13: unexpected symbol near the end");
    EXPECT_EQ(refusal("(function() while true do end end)()"), "--until: does not end within 10000 instructions");
}

TEST_F(Conditions, AreLimitedInLargeScenesToo) {
    SmallWorld world;
    for (int i = 0; i < 10'000; ++i)
        world.parts().scene.robots.push_back({"robot number " + std::to_string(i + 1), 0, 0, 0, {double(i), 0, 0}});
    world.parts().scene.robotTypes = {squareRobot()};
    world.parts().scene.models = {ideal()};
    world.parts().controllers.assign(10'000, std::make_shared<Told>(Command{}));
    scenario_ = world.scenario();
    state_ = scenario_.initialState();
    EXPECT_TRUE(holds("robot[10000].x == 9999 and robot['robot number 77'].x == 76"));
    EXPECT_NE(refusal("(function() local s = 'x' while true do s = s .. s end end)()").find("memory"),
              std::string::npos);
}

TEST_F(Conditions, GiveNumbersTooWhereThoseAreAskedFor) {
    auto far = compileWorldValue("distance(robot.keeper, ball)", scenario_);
    ASSERT_TRUE(far) << far.error().message();
    auto near = compileWorldValue("distance(robot.keeper, ball) < 2", scenario_);
    ASSERT_TRUE(near);
    for (int i = 0; i < 60; ++i) {
        runTicks(1);
        const Pose &a = state_.robots[0].pose, &b = state_.objects[1].pose;
        const double expected = std::hypot(a.x - b.x, a.y - b.y);
        EXPECT_NEAR(*far->value(moment()), expected, 1e-12);
        EXPECT_EQ(*near->value(moment()), expected < 2 ? 1 : 0);
    }
    EXPECT_EQ(far->text(), "distance(robot.keeper, ball)");
}

TEST_F(Conditions, SayWhatIsNoNumber) {
    const auto refusal = [&](const char* text) {
        const auto value = compileWorldValue(text, scenario_);
        return value ? std::string() : value.error().message();
    };
    EXPECT_EQ(refusal("robot[1]"), "expression: gives a value of type robot; expected a number, or true or false");
    EXPECT_EQ(refusal("'a'"), "expression: gives a text; expected a number, or true or false");
    EXPECT_THAT(refusal("robot[9].x"), testing::HasSubstr("expression:1:7: there is no robot 9"));
    EXPECT_THAT(refusal("1 +"), testing::HasSubstr("expression:1:"));
}

}  // namespace
}  // namespace mrose
