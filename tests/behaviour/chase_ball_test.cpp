#include "behaviour/chase_ball.h"

#include <cmath>

#include <gtest/gtest.h>

#include "behaviour/headway.h"
#include "behaviour/small_field.h"
#include "support/observation_parts.h"

namespace mrose {
namespace {

const ChaseBall::Options toTheEast{.target = {9, 2.5}};

RobotType kickingRobot() {
    RobotType type = guideRobot(cameras());
    type.manipulators.push_back({.name = "kicker", .position = {0.17, 0}, .width = 0.25});
    return type;
}

/// Robot and ball somewhere, the ball in the western half, not on one another.
SmallWorld chase(const RobotType& type, std::int64_t which, const ChaseBall::Options& options = toTheEast) {
    SmallWorld world(walledField(9, 5));
    const Pose start = somewhere(81, which, 9, 5);
    Pose ball{draw(81, which, 7, 0.6, 4), draw(81, which, 8, 0.6, 4.4), 0};
    if (distance(position(start), position(ball)) < 0.6) ball.y += ball.y > 2.5 ? -1 : 1;
    world.robot(type, start, std::make_shared<const ChaseBall>(options), noisyDrive(), which % 5);
    world.object(ballType(), ball);
    return world;
}

struct Outcome {
    double arrived = -1;  ///< s, when the ball was well in the eastern half
    double leastWay = 0;  ///< m, of the robot within 40 s
};

Outcome play(const Scenario& scenario, std::uint64_t seed, int seconds) {
    WorldState state = scenario.initialState(seed);
    StepBuffers buffers;
    Outcome outcome;
    Headway progress(40 * ticksPerSecond / 5);
    for (int tick = 0; tick < seconds * ticksPerSecond; ++tick) {
        step(scenario, state, buffers);
        if (outcome.arrived < 0 && state.objects[0].pose.x > 6) outcome.arrived = tick / double(ticksPerSecond);
        if (tick % 5 == 0) progress.watch(state.robots[0].pose);
    }
    outcome.leastWay = progress.leastWay();
    return outcome;
}

TEST(ChaseBall, BringsTheBallToTheTargetsHalf) {
    for (const bool kicks : {false, true}) {
        int arrived = 0;
        for (std::int64_t i = 0; i < 30; ++i) {
            const Scenario scenario = chase(kicks ? kickingRobot() : guideRobot(cameras()), i).scenario();
            arrived += play(scenario, static_cast<std::uint64_t>(i), 60).arrived >= 0 ? 1 : 0;
        }
        EXPECT_GE(arrived, 27) << kicks;
    }
}

/// Long after the ball has come to the wall at the target, or into a corner.
TEST(ChaseBall, NeverGetsStuckForEver) {
    for (std::int64_t i = 0; i < 15; ++i) {
        const Outcome outcome = play(chase(kickingRobot(), i).scenario(), static_cast<std::uint64_t>(i), 240);
        EXPECT_GT(outcome.leastWay, 0.15) << i;
    }
}

/// How long it takes, from when the robot has come to a ball that lies at a wall, until the ball is elsewhere.
double secondsToFree(const RobotType& type, const ChaseBall::Options& options, const Point& ball, std::int64_t which) {
    const Pose start{ball.x + (ball.x < 4.5 ? 1 : -1) * draw(91, which, 0, 0.5, 1.5),
                     ball.y + (ball.y < 2.5 ? 1 : -1) * draw(91, which, 1, 0.5, 1.5), draw(91, which, 2, -3.1, 3.1)};
    const Scenario scenario = SmallWorld(walledField(9, 5))
                                  .robot(type, start, std::make_shared<const ChaseBall>(options),
                                         options.guide ? noisyDrive() : lateDrive(), which % 5)
                                  .object(ballType(), {ball.x, ball.y, 0})
                                  .scenario();
    WorldState state = scenario.initialState(static_cast<std::uint64_t>(which));
    StepBuffers buffers;
    std::int64_t came = -1;
    while (state.tick < 120 * ticksPerSecond) {
        step(scenario, state, buffers);
        const Point now = position(state.objects[0].pose);
        if (came < 0 && distance(now, position(state.robots[0].pose)) < 0.5) came = state.tick;
        if (distance(now, ball) > 0.7)
            return static_cast<double>(state.tick - std::max<std::int64_t>(0, came)) / ticksPerSecond;
    }
    return 120;
}

const std::vector<Point> corners{{0.12, 0.12}, {0.12, 4.88}, {8.88, 4.88}, {8.88, 0.12}};
const std::vector<Point> alongWalls{{3, 0.12}, {5, 4.88}, {0.12, 1.7}, {8.88, 4}};

ChaseBall::Options knowingTheWalls(bool guide) {
    ChaseBall::Options options = toTheEast;
    options.front = guide ? 0.17 : 0.2;
    options.halfWidth = guide ? 0.19 : 0.2;
    options.guide = guide;
    options.walls = floorPlanOf(walledField(9, 5));
    return options;
}

/// In most cases within some seconds; a robot without a guide along walls only.
TEST(ChaseBall, FreesABallFromWallsAndCorners) {
    RobotType disc = discRobot(0.2);
    disc.perception = cameras();
    for (const bool guide : {true, false}) {
        std::vector<Point> places = alongWalls;
        if (guide) places.insert(places.end(), corners.begin(), corners.end());
        int soon = 0, tries = 0;
        for (const Point& ball : places)
            for (std::int64_t i = 0; i < 10; ++i, ++tries)
                soon += secondsToFree(guide ? guideRobot(cameras()) : disc, knowingTheWalls(guide), ball, i) < 10;
        EXPECT_GE(soon, 3 * tries / 4) << (guide ? "with" : "without") << " a guide, of " << tries;
    }
}

std::int64_t phaseOf(const Scenario& scenario, const WorldState& state) {
    return as<ChaseBall::Memory>(scenario.memoryOf(state, 0)).phase;
}

/// A robot before a ball, behind which it sees another stand in the way to the target.
Scenario jam(const ChaseBall::Options& options, std::int64_t which) {
    Perception perception = cameras();
    perception.robots.occlusion = false;
    const Point ball{4.5, draw(92, which, 0, 1, 4)};
    return SmallWorld(walledField(9, 5))
        .robot(guideRobot(perception), {ball.x - 0.6, ball.y + draw(92, which, 1, -0.05, 0.05), 0},
               std::make_shared<const ChaseBall>(options), noisyDrive(), which % 5)
        .robot(discRobot(0.2, 40), {ball.x + 0.35, ball.y, 0}, std::make_shared<const Told>(Command{}), lateDrive())
        .object(ballType(), {ball.x, ball.y, 0})
        .scenario();
}

/// How far the ball comes in six seconds, in sum; and in how many of the cases the robot turns it out.
TEST(ChaseBall, SweepsTheBallOutOfAJamIfItStrikes) {
    ChaseBall::Options strikes = knowingTheWalls(true);
    strikes.stroke.emplace();
    double freed[] = {0, 0};
    int turned[] = {0, 0};
    for (std::int64_t i = 0; i < 20; ++i)
        for (const bool striking : {false, true}) {
            const Scenario scenario = jam(striking ? strikes : knowingTheWalls(true), i);
            WorldState state = scenario.initialState(static_cast<std::uint64_t>(i));
            const Point from = position(state.objects[0].pose);
            StepBuffers buffers;
            bool turns = false;
            while (state.tick < 6 * ticksPerSecond) {
                step(scenario, state, buffers);
                turns = turns || phaseOf(scenario, state) == ChaseBall::sweepingJam;
            }
            freed[striking] += distance(position(state.objects[0].pose), from);
            turned[striking] += turns ? 1 : 0;
        }
    EXPECT_EQ(turned[false], 0);
    EXPECT_GE(turned[true], 15);
    EXPECT_GT(freed[true], 1.5 * freed[false]) << freed[true] << " m and " << freed[false] << " m";
}

/// Its way to a stand beside a ball at a wall takes longer than an opponent's to the ball.
TEST(ChaseBall, TakesAStandForAStrokeOnlyWhereNobodyElseIsNear) {
    ChaseBall::Options options = knowingTheWalls(true);
    options.stroke.emplace();
    options.yields = false;
    for (const double other : {0.0, 1.5, 3.5}) {
        SmallWorld world(walledField(9, 5));
        world.robot(guideRobot({}), {3, 2, 0}, std::make_shared<const ChaseBall>(options), lateDrive())
            .object(ballType(), {4.5, 0.12, 0});
        if (other > 0)
            world.robot(discRobot(0.2), {4.5 + other, 0.5, 0}, std::make_shared<const Told>(Command{}), lateDrive());
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState();
        run(scenario, state, ticksPerSecond);
        EXPECT_EQ(phaseOf(scenario, state) == ChaseBall::striking, other != 1.5) << other;
    }
}

/// A disc cannot get a ball out of a corner, and does not stand in the way of those that can.
TEST(ChaseBall, WithoutAGuideItWaitsAsideOfACorner) {
    for (const Point& ball : corners) {
        RobotType disc = discRobot(0.2);
        disc.perception = cameras();
        const Scenario scenario =
            SmallWorld(walledField(9, 5))
                .robot(disc, {4.5, 2.5, 0}, std::make_shared<const ChaseBall>(knowingTheWalls(false)), lateDrive())
                .object(ballType(), {ball.x, ball.y, 0})
                .scenario();
        WorldState state = scenario.initialState();
        run(scenario, state, 60 * ticksPerSecond);
        const double far = distance(position(state.robots[0].pose), ball);
        EXPECT_TRUE(far > 1.1 && far < 2) << far;
    }
}

TEST(ChaseBall, FindsABallThatLiesBehindIt) {
    const Scenario scenario =
        SmallWorld(walledField(9, 5))
            .robot(guideRobot(cameras()), {5, 2.5, 0}, std::make_shared<const ChaseBall>(toTheEast), noisyDrive())
            .object(ballType(), {2, 2, 0})
            .scenario();
    EXPECT_GE(play(scenario, 4, 60).arrived, 0);
}

struct Kicked {
    int hits = 0, misses = 0, faults = 0;
    double fastest = 0;
};

Kicked kicksOf(const RobotType& type, const ChaseBall::Options& options) {
    Kicked result;
    for (std::int64_t i = 0; i < 5; ++i) {
        const Scenario scenario = chase(type, i, options).scenario();
        WorldState state = scenario.initialState(static_cast<std::uint64_t>(i));
        StepBuffers buffers;
        StepTrace trace;
        for (int tick = 0; tick < 60 * ticksPerSecond; ++tick) {
            step(scenario, state, buffers, {}, &trace);
            for (const StepTrace::Kicked& kick : trace.kicks) (kick.hit ? result.hits : result.misses) += 1;
            result.faults += static_cast<int>(trace.faults.size());
            result.fastest =
                std::max(result.fastest, std::hypot(state.objects[0].velocity_W.x, state.objects[0].velocity_W.y));
        }
    }
    return result;
}

TEST(ChaseBall, KicksWhereItHasSomethingToKickWithAndMay) {
    const Kicked kicking = kicksOf(kickingRobot(), toTheEast);
    EXPECT_GE(kicking.hits, 5);
    EXPECT_GT(kicking.hits, 2 * kicking.misses);
    EXPECT_GT(kicking.fastest, 2.5);
    ChaseBall::Options gentle = toTheEast;
    gentle.kicks = false;
    for (const Kicked& without : {kicksOf(guideRobot(cameras()), toTheEast), kicksOf(kickingRobot(), gentle)}) {
        EXPECT_EQ(without.hits + without.misses, 0);
        EXPECT_EQ(without.faults, 0);
        EXPECT_LT(without.fastest, 1.5);
    }
}

/// Shows a robot at the origin a ball, every 100 ms, and gives what it aims at.
class Aiming {
public:
    explicit Aiming(double speed) : controller_({.target = {1000, 0}, .speed = speed, .rotation = speed}) {}

    Point at(const Point& ball) {
        ObservationParts observation;
        observation.time = observation.selfMeasured = instant_++ * 100'000'000LL;
        observation.localised = true;
        observation.objects = {{0, ball, observation.time}};
        Decision decision;
        controller_.decide(observation, memory_, decision);
        for (const Annotation& annotation : decision.annotations)
            if (annotation.label == "aim") return annotation.points[0];
        return {};
    }

private:
    std::int64_t instant_ = 0;
    ChaseBall controller_;
    std::vector<std::byte> memory_ = std::vector<std::byte>(controller_.memorySize());
};

/// It aims at the line from the ball to the target, 0.4 m ahead of itself.
TEST(ChaseBall, AimsByWhereTheBallWillBeWhenTheCommandTakesEffect) {
    Aiming aiming(0);
    const auto rolled = [](double t) { return 0.8 * t - 0.4 * t * t / 2 - 0.6; };
    Point aim;
    for (int i = 0; i <= 10; ++i) aim = aiming.at({0.7, rolled(0.1 * i)});
    EXPECT_NEAR(rolled(1), 0, 1e-12);
    EXPECT_NEAR(aim.y, rolled(1.3), 0.03);
}

TEST(ChaseBall, AimsFromWhereItWillBeWhenTheCommandTakesEffect) {
    Aiming aiming(0.4);
    // It is told 0.4 m/s, and does not move yet.
    for (const double ahead : {0.0, 0.04, 0.08, 0.12, 0.12}) {
        const Point aim = aiming.at({0.7, 0});
        EXPECT_NEAR(aim.x, ahead + 0.4, 1e-3);
        EXPECT_NEAR(aim.y, 0, 1e-3);
    }
}

TEST(ChaseBall, ShowsWhatItBelievesAndWants) {
    const Scenario scenario = chase(guideRobot({}), 1).scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    while (state.tick < 2 * ticksPerSecond || !trace.robots[0].decided) step(scenario, state, buffers, {}, &trace);
    std::vector<std::string> labels;
    for (const Annotation& annotation : trace.robots[0].decision.annotations) {
        labels.push_back(annotation.label);
        if (annotation.label == "ball") {
            EXPECT_LT(distance(annotation.points[0], position(state.objects[0].pose)), 0.05);
        } else if (annotation.label == "shot") {
            EXPECT_EQ(annotation.points[1], toTheEast.target);
        }
    }
    EXPECT_EQ(labels, (std::vector<std::string>{"state", "ball", "ball speed (m/s)", "aim", "shot"}));
}

}  // namespace
}  // namespace mrose
