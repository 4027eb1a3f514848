#include "behaviour/wall_stroke.h"

#include <gtest/gtest.h>

#include "behaviour/chase_ball.h"
#include "behaviour/free_ball.h"
#include "behaviour/small_field.h"
#include "support/units.h"

namespace mrose {
namespace {

constexpr double ballRadius = 0.11;

WallStroke atWall(double side, const Point& away) {
    WallStroke stroke{};
    stroke.side = side;
    stroke.away = away;
    return stroke;
}

/// At the south wall the ball goes east, and the robot stops west of it, heading into the wall; mirrored and turned
/// likewise.
TEST(WallStroke, StopsBeforeTheBallHeadingIntoTheWall) {
    const WallStroke::Options options{.standOff = 0.4, .stopDistance = 0.3, .approach = 0.7};
    const struct {
        double side;
        Point away, ball;
        Pose stance;
    } cases[] = {{1, {0, 1}, {2, ballRadius}, {1.7, 0.4, -0.7}},
                 {-1, {0, 1}, {2, ballRadius}, {2.3, 0.4, 0.7 - pi}},
                 {1, {0, -1}, {2, 5 - ballRadius}, {2.3, 4.6, pi - 0.7}},
                 {1, {-1, 0}, {9 - ballRadius, 3}, {8.6, 2.7, pi / 2 - 0.7}}};
    for (const auto& one : cases) {
        const Pose stance = atWall(one.side, one.away).stance(one.ball, options);
        EXPECT_NEAR(stance.x, one.stance.x, 1e-12);
        EXPECT_NEAR(stance.y, one.stance.y, 1e-12);
        EXPECT_NEAR(wrapAngle(stance.heading - one.stance.heading), 0, 1e-12);
    }
}

/// What it commands from where it stops, if the robot does at once what it is commanded.
struct Strike {
    std::vector<Command> commands;  ///< until it is over
    double turned = 0;              ///< rad, while it turned
};

Strike strikeFromStance(double side, const WallStroke::Options& options, const FloorPlan& walls) {
    const Point ball{4, ballRadius}, centre{4.5, 2.5};
    WallStroke stroke = atWall(side, {0, 1});
    Pose robot = stroke.stance(ball, options);
    Strike strike;
    Nanoseconds time = 0;
    for (int i = 0; i < 100; ++i, time += 100'000'000) {
        const auto command = stroke.update({time, robot, ball, centre, walls}, options);
        if (stroke.strokes > 0 && !stroke.strikes()) break;
        EXPECT_TRUE(command);
        if (!command) break;
        if (stroke.strikes()) {
            strike.commands.push_back(*command);
            strike.turned += 0.1 * command->w;
        }
        robot = robot * exp({0.1 * command->v, 0, 0.1 * command->w});
    }
    EXPECT_EQ(stroke.strokes, 1);
    return strike;
}

TEST(WallStroke, LungesTurnsToTheFieldAndFollows) {
    const FloorPlan walls = *floorPlanOf(walledField(9, 5));
    const WallStroke::Options options{.speed = 0.4,
                                      .lead = 0.3,
                                      .leadSpeed = 0.35,
                                      .turnSpeed = 0.2,
                                      .strokeRotation = 1.5,
                                      .turn = 1.2,
                                      .follow = 0.4};
    for (const double side : {1.0, -1.0}) {
        const Strike strike = strikeFromStance(side, options, walls);
        EXPECT_NEAR(side * strike.turned, options.turn, 0.15 + 1e-9) << "to a control period";
        std::size_t i = 0;
        for (; i < 3; ++i) EXPECT_EQ(strike.commands.at(i), (Command{0.35, 0}));
        for (; i < strike.commands.size() && strike.commands[i].w != 0; ++i)
            EXPECT_EQ(strike.commands[i], (Command{0.2, side * 1.5}));
        EXPECT_EQ(strike.commands.size() - i, 4u);
        for (; i < strike.commands.size(); ++i) EXPECT_EQ(strike.commands[i], (Command{0.4, 0}));
    }
}

/// Whether it would do something.
bool wouldGo(const Point& ball, const FloorPlan& walls, const Pose& robot = {4.5, 2.5, 0},
             const WallStroke::Options& options = {}) {
    WallStroke stroke{};
    return stroke.update({0, robot, ball, {4.5, 2.5}, walls}, options).has_value();
}

TEST(WallStroke, IsForBallsAtWallsWhereThereIsRoom) {
    const FloorPlan walls = *floorPlanOf(walledField(9, 5)), lane = *floorPlanOf(walledField(9, 0.6));
    EXPECT_TRUE(wouldGo({4, 0.12}, walls));
    EXPECT_TRUE(wouldGo({8.88, 2}, walls));
    EXPECT_FALSE(wouldGo({4, 1.5}, walls));
    EXPECT_FALSE(wouldGo({5, 3}, walls));
    EXPECT_FALSE(wouldGo({4, 0.12}, FloorPlan())) << "it knows of no walls";
    const Pose within{5.5, 0.3, 0};
    WallStroke::Options small;
    small.reach = 0.2;
    EXPECT_FALSE(wouldGo({4, 0.12}, lane, within)) << "a lane narrower than the robot";
    EXPECT_TRUE(wouldGo({4, 0.12}, lane, within, small));
}

TEST(WallStroke, TakesABallThatLooksAsIfItLayBehindTheWallForOneAtIt) {
    const FloorPlan walls = *floorPlanOf(walledField(9, 5));
    WallStroke stroke{};
    ASSERT_TRUE(stroke.update({0, {4, 2, 0}, {4, -0.35}, {4.5, 2.5}, walls}, {}));
    EXPECT_NEAR(stroke.away.y, 1, 1e-9);
    EXPECT_NEAR(stroke.lies.y, ballRadius, 0.02);
}

/// Away from the corner that is near, and from the nearer side where both are as good.
TEST(WallStroke, StrikesToWhereTheBallHasAWay) {
    const FloorPlan walls = *floorPlanOf(walledField(9, 5));
    const auto goesEast = [&](const Point& ball, const Pose& robot) {
        WallStroke stroke{};
        EXPECT_TRUE(stroke.update({0, robot, ball, ball + Point{0, 1}, walls}, {}));
        return stroke.side * stroke.away.y > 0;  // at the south wall to the left of its way
    };
    EXPECT_TRUE(goesEast({0.62, 0.12}, {1.2, 1, 0}));
    EXPECT_FALSE(goesEast({8.38, 0.12}, {7.8, 1, 0}));
    EXPECT_TRUE(goesEast({4.5, 0.12}, {3.5, 1, 0}));
    EXPECT_FALSE(goesEast({4.5, 0.12}, {5.5, 1, 0}));
}

struct Freed {
    int freed = 0;           ///< of all starts, within 40 s
    double meanSeconds = 0;  ///< of these
};

/// Balls along all four walls, the robot within 2 m.
Freed freed(const std::shared_ptr<const Controller>& controller, int starts) {
    Freed result;
    for (int i = 0; i < starts; ++i) {
        const double along = draw(95, i, 0, 1, 4);
        const Point balls[] = {{2 * along, 0.115}, {2 * along, 4.885}, {0.115, along}, {8.885, along}};
        const Point ball = balls[i % 4];
        const Point inwards = Point{4.5, 2.5} - ball;
        const Point start = ball + (draw(95, i, 1, 0.8, 2) / length(inwards)) * inwards;
        const Scenario scenario = SmallWorld(walledField(9, 5))
                                      .robot(guideRobot(cameras()), {start.x, start.y, draw(95, i, 2, -3.1, 3.1)},
                                             controller, noisyDrive(), i % 5)
                                      .object(ballType(), {ball.x, ball.y, 0})
                                      .scenario();
        WorldState state = scenario.initialState(static_cast<std::uint64_t>(i));
        StepBuffers buffers;
        while (state.tick < 40 * ticksPerSecond) {
            step(scenario, state, buffers);
            const Pose& now = state.objects[0].pose;
            if (std::min(std::min(now.x, 9 - now.x), std::min(now.y, 5 - now.y)) < ballRadius + 0.3) continue;
            ++result.freed;
            result.meanSeconds += state.tick / double(ticksPerSecond);
            break;
        }
    }
    result.meanSeconds /= std::max(1, result.freed);
    return result;
}

/// What only pushes leaves the ball at the wall.
TEST(FreeBall, GetsTheBallOffTheWallWhereAPushDoesNot) {
    FreeBall::Options options;
    options.towards = {4.5, 2.5};
    options.walls = floorPlanOf(walledField(9, 5));
    options.stroke.within = 0.3;
    options.stroke.rotation = 1.5;
    const Freed strikes = freed(std::make_shared<const FreeBall>(options), 40);
    const Freed pushes = freed(std::make_shared<const ChaseBall>(ChaseBall::Options{.target = {9, 2.5}}), 40);
    EXPECT_GE(strikes.freed, 34);
    EXPECT_LT(strikes.meanSeconds, 20);
    EXPECT_LT(pushes.freed, 30);
}

TEST(FreeBall, LeavesABallAloneThatIsFree) {
    FreeBall::Options options;
    options.walls = floorPlanOf(walledField(9, 5));
    const Scenario scenario =
        SmallWorld(walledField(9, 5))
            .robot(guideRobot(cameras()), {3, 2, 1}, std::make_shared<const FreeBall>(options), noisyDrive(), 0)
            .object(ballType(), {4.5, 2.5, 0})
            .scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 20 * ticksPerSecond);
    EXPECT_EQ(position(state.objects[0].pose), (Point{4.5, 2.5}));
    EXPECT_EQ(explained(scenario.controller(0), scenario.memoryOf(std::as_const(state), 0)).at(0).text, "free");
}

TEST(FreeBall, TurnsABallOutOfACorner) {
    FreeBall::Options options;
    options.towards = {4.5, 2.5};
    options.walls = floorPlanOf(walledField(9, 5));
    options.stroke.rotation = 1.5;
    int out = 0;
    for (int i = 0; i < 12; ++i) {
        const Point corners[] = {{0.115, 0.115}, {8.885, 0.115}, {8.885, 4.885}, {0.115, 4.885}};
        const Point ball = corners[i % 4];
        const Scenario scenario = SmallWorld(walledField(9, 5))
                                      .robot(guideRobot(cameras()), {4.5, 2.5, 0.5 * i},
                                             std::make_shared<const FreeBall>(options), noisyDrive(), i % 5)
                                      .object(ballType(), {ball.x, ball.y, 0})
                                      .scenario();
        WorldState state = scenario.initialState(static_cast<std::uint64_t>(i));
        StepBuffers buffers;
        while (state.tick < 60 * ticksPerSecond && distance(position(state.objects[0].pose), ball) < 0.5)
            step(scenario, state, buffers);
        out += state.tick < 60 * ticksPerSecond ? 1 : 0;
    }
    EXPECT_GE(out, 9);
}

}  // namespace
}  // namespace mrose
