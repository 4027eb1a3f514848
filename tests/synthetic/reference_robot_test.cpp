#include "synthetic/reference_robot.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace mrose {
namespace {

static_assert(std::is_trivially_copyable_v<ReferenceRobotState>);

using Observer = std::function<void(const ReferenceRobotState&)>;

struct Sent {
    double time = 0;  // s
    Command command;
};

/// Runs the robot to `end`, in s, and shows each state.
ReferenceRobotState run(const ReferenceRobot& robot, ReferenceRobotState state, const std::vector<Sent>& sent,
                        double end, const Observer& observe = {}) {
    std::size_t next = 0;
    while (next < sent.size() && fromSeconds(sent[next].time) < state.time) ++next;
    while (state.time < fromSeconds(end)) {
        for (; next < sent.size() && fromSeconds(sent[next].time) <= state.time; ++next)
            state = robot.issue(state, sent[next].command);
        state = robot.next(state);
        if (observe) observe(state);
    }
    return state;
}

/// Nothing that differs from run to run, and both sides alike.
ReferenceRobotParameters exactParameters() {
    ReferenceRobotParameters p;
    p.wheelNoise = p.commonNoise = p.scrubNoise = 0;
    p.deadTimeJitter = p.samplingJitter = 0;
    p.wheelScale = {1, 1};
    p.casterTurn = 0;
    return p;
}

TEST(ReferenceRobot, SameSeedSameBitsAndAnotherSeedOthers) {
    const std::vector<Sent> sent{{0.5, {0.4, 0.3}}, {2, {-0.2, -1}}, {3, {0, 0}}};
    const auto end = [&](std::uint64_t seed) {
        const ReferenceRobot robot(seed);
        return run(robot, robot.start({1, 2, 3}), sent, 5).pose;
    };
    const Pose first = end(7), again = end(7), other = end(8);
    EXPECT_EQ(std::memcmp(&first, &again, sizeof first), 0);
    EXPECT_NE(first.x, other.x);
    EXPECT_NEAR(first.x, other.x, 0.1);
}

TEST(ReferenceRobot, ACopiedStateGoesOnLikeTheFirst) {
    const ReferenceRobot robot(3);
    const std::vector<Sent> sent{{0.5, {0.4, 0.3}}, {2, {-0.2, -1}}};
    const ReferenceRobotState half = run(robot, robot.start({}), sent, 2.1), whole = run(robot, half, sent, 4);
    EXPECT_EQ(run(robot, half, sent, 4).pose, whole.pose);
    EXPECT_EQ(run(robot, robot.start({}), sent, 4).pose, whole.pose);
}

TEST(ReferenceRobot, ACommandReachesTheWheelsAfterDeadTimeAndSampling) {
    double earliest = 1e9, latest = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const ReferenceRobot robot(seed, exactParameters());
        double moved = 0;
        run(robot, robot.start({}), {{1, {0.4, 0}}}, 2, [&](const ReferenceRobotState& state) {
            if (moved == 0 && state.setPoint.v != 0) moved = toSeconds(state.time) - 1;
        });
        earliest = std::min(earliest, moved);
        latest = std::max(latest, moved);
    }
    const ReferenceRobotParameters p;
    const double step = toSeconds(ReferenceRobot::step);
    EXPECT_GE(earliest, p.deadTime);
    EXPECT_LE(latest, p.deadTime + p.samplingPeriod + p.servoPeriod + 2 * step);
    EXPECT_LT(earliest, p.deadTime + 0.01);  // the phase of sampling is random
    EXPECT_GT(latest, earliest + p.servoPeriod);
}

TEST(ReferenceRobot, TheDeadTimeOfTheLinkJittersAsSaid) {
    const ReferenceRobot robot(5);
    ReferenceRobotState state = robot.start({});
    double sum = 0, squares = 0;
    constexpr int count = 2000;
    for (int i = 0; i < count; ++i) {
        state.linkSize = 0;  // each on its own: a later command never overtakes
        state = robot.issue(state, {0.1, 0});
        const double delay = toSeconds(state.link[0].time - state.time);
        sum += delay;
        squares += delay * delay;
    }
    const double mean = sum / count, deviation = std::sqrt(squares / count - mean * mean);
    const ReferenceRobotParameters p;
    EXPECT_NEAR(mean, 0.3, 4 * p.deadTimeJitter / std::sqrt(count));
    EXPECT_NEAR(deviation, p.deadTimeJitter, 0.1 * p.deadTimeJitter);
}

/// It goes on from the velocity that something has given it, and back to what it is told.
TEST(ReferenceRobot, GoesOnFromAPush) {
    const ReferenceRobot robot(4);
    const std::vector<Sent> sent{{0, {0.3, 0.4}}};
    const ReferenceRobotState drives = run(robot, robot.start({}), sent, 3);
    EXPECT_NEAR(drives.velocity.v, 0.3, 0.02);
    for (const Velocity& velocity : {Velocity{0, 0}, Velocity{-0.2, 0.4}, Velocity{0.3, -1}}) {
        ReferenceRobotState pushed = robot.pushed(drives, velocity);
        EXPECT_EQ(pushed.velocity, velocity);
        pushed = robot.next(pushed);
        EXPECT_NEAR(pushed.velocity.v, velocity.v, 0.03);
        EXPECT_NEAR(pushed.velocity.w, velocity.w, 0.1);
        pushed = run(robot, pushed, {}, 5);
        EXPECT_NEAR(pushed.velocity.v, 0.3, 0.02);
        EXPECT_NEAR(pushed.velocity.w, 0.4, 0.05);
    }
}

TEST(ReferenceRobot, WithoutASeedNothingIsRandom) {
    ReferenceRobotParameters exact;
    exact.wheelNoise = exact.commonNoise = exact.scrubNoise = exact.deadTimeJitter = exact.samplingJitter = 0;
    const ReferenceRobot robot(std::nullopt);
    ReferenceRobotState state = robot.start({});
    EXPECT_EQ(state.nextSample, fromSeconds(ReferenceRobotParameters{}.samplingPeriod / 2));
    EXPECT_EQ(state.casterAngle, 0);
    const std::vector<Sent> sent{{0.5, {0.4, 0.3}}, {2, {-0.2, -1}}};
    ReferenceRobotState seeded = ReferenceRobot(9, exact).start({});
    seeded.nextSample = state.nextSample;
    seeded.casterAngle = 0;
    EXPECT_EQ(run(robot, state, sent, 4).pose, run(ReferenceRobot(9, exact), seeded, sent, 4).pose);
}

TEST(ReferenceRobot, CommandsArriveInTheirOrder) {
    const ReferenceRobot robot(11);
    ReferenceRobotState state = robot.start({});
    for (int i = 0; i < 20; ++i) state = robot.issue(robot.next(state), {0.01 * i, 0});  // 2 ms apart, jitter 9 ms
    for (std::size_t i = 1; i < state.linkSize; ++i) EXPECT_GE(state.link[i].time, state.link[i - 1].time);
    for (int i = 0; i < 100; ++i) state = robot.issue(state, {0.2, 0});
    EXPECT_EQ(state.linkSize, ReferenceRobotState::linkCapacity);
}

TEST(ReferenceRobot, SetPointsKeepTheLimitsOfSpeedAndAcceleration) {
    const ReferenceRobot robot(2);
    const ReferenceRobotParameters p;
    Command before;
    double fastest = 0, fastestTurn = 0, steepest = 0, steepestTurn = 0;
    run(robot, robot.start({}), {{0.5, {2, 9}}, {4, {-2, -9}}, {9, {0, 0}}}, 12, [&](const ReferenceRobotState& s) {
        fastest = std::max(fastest, std::abs(s.setPoint.v));
        fastestTurn = std::max(fastestTurn, std::abs(s.setPoint.w));
        steepest = std::max(steepest, std::abs(s.setPoint.v - before.v) / p.servoPeriod);
        steepestTurn = std::max(steepestTurn, std::abs(s.setPoint.w - before.w) / p.servoPeriod);
        before = s.setPoint;
    });
    EXPECT_DOUBLE_EQ(fastest, 0.4);
    EXPECT_DOUBLE_EQ(fastestTurn, 100 * M_PI / 180);
    EXPECT_NEAR(steepest, 0.5, 1e-9);
    EXPECT_NEAR(steepestTurn, 300 * M_PI / 180, 1e-9);
}

TEST(ReferenceRobot, ReachesFullSpeedNoSoonerThanTheAccelerationAllows) {
    const ReferenceRobot robot(2, exactParameters());
    double reached = 0, fastest = 0;
    const auto last = run(robot, robot.start({}), {{1, {0.4, 0}}}, 6, [&](const ReferenceRobotState& state) {
        if (reached == 0 && state.velocity.v > 0.39) reached = toSeconds(state.time) - 1;
        fastest = std::max(fastest, state.velocity.v);
    });
    EXPECT_GT(reached, 0.3 + 0.39 / (1.08 * 0.5));  // the loop runs up to 8 % ahead of its set-point
    EXPECT_LT(reached, 0.3 + 0.39 / 0.5 + 0.35);
    EXPECT_LT(fastest, 0.4 * 1.08);
    EXPECT_NEAR(last.velocity.v, 0.4, 0.01);  // encoders
}

TEST(ReferenceRobot, WheelsAtTheirLimitTakeFromSpeedAndTurn) {
    const ReferenceRobot robot(2, exactParameters());
    double fastestWheel = 0;
    const auto last = run(robot, robot.start({}), {{0.5, {0.4, 1.7}}}, 6, [&](const ReferenceRobotState& state) {
        if (state.time > fromSeconds(4))
            for (const auto& wheel : state.wheels) fastestWheel = std::max(fastestWheel, std::abs(wheel.speed));
    });
    const ReferenceRobotParameters p;
    EXPECT_NEAR(fastestWheel, p.largestWheelSpeed, 0.02);
    EXPECT_LT(last.velocity.v, 0.35);
    EXPECT_LT(last.velocity.w, 1.6);
}

TEST(ReferenceRobot, StandsExactlyStillOnceItHasStopped) {
    const ReferenceRobot robot(4);
    const std::vector<Sent> sent{{0.5, {0.4, 0.5}}, {3, {0, 0}}};
    const Pose stopped = run(robot, robot.start({}), sent, 5).pose, later = run(robot, robot.start({}), sent, 9).pose;
    EXPECT_EQ(stopped, later);
    EXPECT_GT(stopped.x, 0.2);
}

TEST(ReferenceRobot, AWrongStartVelocityRecovers) {
    const ReferenceRobot robot(6);
    const std::vector<Sent> sent{{0.5, {0.3, 0.4}}};
    ReferenceRobotState right = run(robot, robot.start({}), sent, 4), wrong = right;
    wrong.wheels[0].speed -= 0.1;
    wrong.wheels[1].speed += 0.05;
    const auto differenceAt = [&](double time) {
        const Velocity a = run(robot, right, {}, time).velocity, b = run(robot, wrong, {}, time).velocity;
        return std::abs(a.v - b.v) + 0.165 * std::abs(a.w - b.w);
    };
    EXPECT_GT(differenceAt(4.01), 0.05);
    EXPECT_LT(differenceAt(4.2), 0.05);
    EXPECT_LT(differenceAt(5.5), 0.005);
}

TEST(ReferenceRobot, SlipsOutOfACurveAndTurnsLessThanItsWheels) {
    for (const double turn : {0.8, -0.8}) {
        const ReferenceRobot robot(9, exactParameters());
        const auto sent = std::vector<Sent>{{0.5, {0.3, turn}}};
        const ReferenceRobotState a = run(robot, robot.start({}), sent, 5);
        const ReferenceRobotState b = robot.next(a);
        const Pose moved = relative(a.pose, b.pose);
        const double arc = moved.x * moved.heading / 2;  // sideways on a circle without slip
        EXPECT_LT((moved.y - arc) * turn, 0);
        const double wheels = (b.wheels[1].speed - b.wheels[0].speed) / robot.parameters().track;
        EXPECT_LT(std::abs(b.velocity.w), 0.97 * std::abs(wheels));
        EXPECT_GT(b.velocity.w * turn, 0);
    }
}

TEST(ReferenceRobot, TyresScrubOnTheSpotByTheShareThatIsSaid) {
    const ReferenceRobot robot(9, exactParameters());
    const ReferenceRobotState state = run(robot, robot.start({}), {{0.5, {0, 1}}}, 4);
    const double wheels = (state.wheels[1].speed - state.wheels[0].speed) / robot.parameters().track;
    EXPECT_NEAR(wheels, 1, 0.02);
    EXPECT_NEAR(state.velocity.w / wheels, 1 - robot.parameters().scrub, 0.002);
}

TEST(ReferenceRobot, UnequalWheelsBendAStraightLine) {
    ReferenceRobotParameters p = exactParameters();
    p.wheelScale = {0.99, 1.01};
    const ReferenceRobot robot(9, p), even(9, exactParameters());
    const std::vector<Sent> sent{{0.5, {0.3, 0}}};
    EXPECT_GT(run(robot, robot.start({}), sent, 6).pose.heading, 0.05);
    EXPECT_NEAR(run(even, even.start({}), sent, 6).pose.heading, 0, 0.01);
}

TEST(ReferenceRobot, ACommandBelowStictionMovesItOnlyAfterAWhile) {
    const auto startsAfter = [](double speed) {
        const ReferenceRobot robot(9, exactParameters());
        double moved = 0;
        run(robot, robot.start({}), {{1, {speed, 0}}}, 4, [&](const ReferenceRobotState& state) {
            if (moved == 0 && state.velocity.v > 0) moved = toSeconds(state.time) - 1;
        });
        return moved;
    };
    EXPECT_GT(startsAfter(0.008), startsAfter(0.2) + 0.1);
}

TEST(ReferenceRobot, AMisalignedCasterPushesItAside) {
    ReferenceRobotParameters p = exactParameters();
    const auto headingAfter = [&](double angle) {
        const ReferenceRobot robot(9, p);
        ReferenceRobotState state = robot.start({});
        state.casterAngle = angle;
        return run(robot, state, {{0.5, {0.3, 0}}}, 3).pose.heading;
    };
    EXPECT_NEAR(headingAfter(1), headingAfter(-1), 1e-12);
    p.casterTurn = ReferenceRobotParameters{}.casterTurn;
    EXPECT_LT(headingAfter(1), headingAfter(-1) - 0.001);
}

}  // namespace
}  // namespace mrose
