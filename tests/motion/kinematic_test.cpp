#include "motion/kinematic.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

constexpr double period = 0.1;

CommandHistory constant(const Command& command) {
    CommandHistory history;
    history.issue(-10'000 * ms, command);
    return history;
}

MotionStep stepOf(const KinematicParameters& parameters, const CommandHistory& commands, Velocity velocity = {},
                  Nanoseconds start = 0) {
    return KinematicModel(parameters).predictOne({&commands, start, velocity});
}

TEST(Kinematic, IdealModelFollowsTheArcOfTheCommandWhateverItsVelocity) {
    const MotionStep step = stepOf({}, constant({0.4, -1.5}), {3, 2});
    const Pose arc = exp({0.04, 0, -0.15});
    EXPECT_NEAR(step.increment.x, arc.x, 1e-15);
    EXPECT_NEAR(step.increment.y, arc.y, 1e-15);
    EXPECT_NEAR(step.increment.heading, arc.heading, 1e-15);
    EXPECT_EQ(step.velocity, (Velocity{0.4, -1.5}));
}

TEST(Kinematic, LagApproachesTheCommandAsAFirstOrderStepResponse) {
    KinematicParameters parameters;
    parameters.v = {.lag = 0.17, .gain = 0.9};
    const double target = 0.9 * 0.4, start = 0.1, decay = std::exp(-period / 0.17);
    const MotionStep step = stepOf(parameters, constant({0.4, 0}), {start, 0});
    EXPECT_NEAR(step.velocity.v, start + (target - start) * (1 - decay), 1e-15);
    EXPECT_NEAR(step.increment.x, target * period + (start - target) * 0.17 * (1 - decay), 1e-15);
    EXPECT_EQ(step.increment.y, 0);
}

TEST(Kinematic, CommandTakesEffectAfterTheDeadTimeOfItsChannelWithinThePeriod) {
    KinematicParameters parameters;
    parameters.v.deadTime = 0.037;
    parameters.w.deadTime = 0.081;
    CommandHistory history = constant({0.1, 0.2});
    history.issue(0, {0.5, -1});
    const MotionStep step = stepOf(parameters, history);
    // Before 37 ms the old command, to 81 ms the new speed with the old rotation, then the new one.
    const Pose expected =
        exp({0.1 * 0.037, 0, 0.2 * 0.037}) * exp({0.5 * 0.044, 0, 0.2 * 0.044}) * exp({0.5 * 0.019, 0, -1 * 0.019});
    EXPECT_NEAR(step.increment.x, expected.x, 1e-15);
    EXPECT_NEAR(step.increment.y, expected.y, 1e-15);
    EXPECT_NEAR(step.increment.heading, expected.heading, 1e-15);
    EXPECT_EQ(step.velocity, (Velocity{0.5, -1}));
}

TEST(Kinematic, DeadTimeLongerThanThePeriodDelaysByWholeAndPartPeriods) {
    KinematicParameters parameters;
    parameters.v.deadTime = 0.334;
    CommandHistory history;
    history.issue(0, {1, 0});
    const KinematicModel model(parameters);
    for (int i = 0; i < 6; ++i) {
        const Nanoseconds start = i * 100 * ms;
        const double moving = std::clamp(toSeconds(start) + period - 0.334, 0.0, period);
        EXPECT_NEAR(model.predictOne({&history, start, {}}).increment.x, moving, 1e-15) << i;
    }
}

TEST(Kinematic, ReadsNoCommandIssuedAfterTheStart) {
    CommandHistory history = constant({0.2, 0.1});
    history.issue(0, {0.3, 0.3});
    const KinematicParameters parameters{.v = {.lag = 0.1}, .w = {.deadTime = 0.02}};
    const MotionStep before = stepOf(parameters, history);
    history.issue(1, {-5, 5});
    history.issue(50 * ms, {9, 9});
    const MotionStep after = stepOf(parameters, history);
    EXPECT_EQ(before.increment, after.increment);
    EXPECT_EQ(before.velocity, after.velocity);
}

TEST(Kinematic, LimitCutsTheCommandOnBothSides) {
    KinematicParameters parameters;
    parameters.v.limit = 0.3;
    parameters.w.limit = 1;
    EXPECT_EQ(stepOf(parameters, constant({0.5, -2})).velocity, (Velocity{0.3, -1}));
    EXPECT_EQ(stepOf(parameters, constant({-0.5, 2})).velocity, (Velocity{-0.3, 1}));
}

TEST(Kinematic, AccelerationLimitGivesARampAndThenTheTarget) {
    KinematicParameters parameters;
    parameters.v.acceleration = 5;
    const MotionStep reached = stepOf(parameters, constant({0.4, 0}), {0.1, 0});
    EXPECT_NEAR(reached.velocity.v, 0.4, 1e-15);
    EXPECT_NEAR(reached.increment.x, (0.1 + 0.4) / 2 * 0.06 + 0.4 * 0.04, 1e-15);
    parameters.v.acceleration = 2;
    const MotionStep underway = stepOf(parameters, constant({-0.4, 0}), {0.1, 0});
    EXPECT_NEAR(underway.velocity.v, 0.1 - 0.2, 1e-15);
    EXPECT_NEAR(underway.increment.x, 0, 1e-15);
}

TEST(Kinematic, BiasActsOnlyWhileACommandMovesTheRobot) {
    KinematicParameters parameters;
    parameters.w.bias = 0.05;
    EXPECT_EQ(stepOf(parameters, constant({0, 0})).increment, Pose{});
    EXPECT_NEAR(stepOf(parameters, constant({0.1, 0})).increment.heading, 0.005, 1e-16);
}

TEST(Kinematic, PointAheadOfTheAxleSwingsSideways) {
    KinematicParameters parameters;
    parameters.lateralPerRotation = 0.08;
    const Pose pose = stepOf(parameters, constant({0, 2})).increment;
    // A point 8 cm ahead of a centre that stays where it is.
    EXPECT_NEAR(pose.x, 0.08 * (std::cos(0.2) - 1), 1e-15);
    EXPECT_NEAR(pose.y, 0.08 * std::sin(0.2), 1e-15);
}

TEST(Kinematic, WrongStartVelocityDecaysWithTheLag) {
    KinematicParameters parameters;
    parameters.v.lag = 0.1;
    parameters.w.lag = 0.14;
    const CommandHistory history = constant({0.08, 0.3});
    const KinematicModel model(parameters);
    Velocity right{0.05, 0.1}, wrong{0.10, -0.2};
    for (int i = 1; i <= 10; ++i) {
        right = model.predictOne({&history, i * 100 * ms, right}).velocity;
        wrong = model.predictOne({&history, i * 100 * ms, wrong}).velocity;
        EXPECT_NEAR(wrong.v - right.v, 0.05 * std::exp(-i), 1e-15);
        EXPECT_NEAR(wrong.w - right.w, -0.3 * std::exp(-i / 1.4), 1e-15);
    }
}

/// The same laws integrated by brute force: 1e5 midpoint steps of the period, each with the velocities' derivative.
MotionStep bruteForce(const KinematicParameters& p, const MotionInput& input) {
    constexpr int steps = 100'000;
    constexpr double h = period / steps;
    Velocity u = input.velocity;
    Pose pose;
    const auto advance = [](double from, double target, const KinematicParameters::Channel& c) {
        if (c.lag == 0 && c.acceleration == 0) return target;
        double change = c.lag > 0 ? (target - from) * -std::expm1(-h / c.lag) : target - from;
        if (c.acceleration > 0 && std::abs(target - from) > c.acceleration * c.lag)
            change = std::clamp(change, -c.acceleration * h, c.acceleration * h);
        return from + change;
    };
    for (int i = 0; i < steps; ++i) {
        const Nanoseconds now = input.start + i * (100 * ms / steps);
        const Command cv = input.commands.at(std::min(now - fromSeconds(p.v.deadTime), input.start));
        const Command cw = input.commands.at(std::min(now - fromSeconds(p.w.deadTime), input.start));
        const bool standing = cv.v == 0 && cw.w == 0;
        const auto target = [&](double command, const KinematicParameters::Channel& c) {
            const double t = standing ? 0 : c.gain * command + c.bias;
            return c.limit > 0 ? std::clamp(t, -c.limit, c.limit) : t;
        };
        const Velocity next{advance(u.v, target(cv.v, p.v), p.v), advance(u.w, target(cw.w, p.w), p.w)};
        const double v = (u.v + next.v) / 2, w = (u.w + next.w) / 2, heading = pose.heading + w * h / 2;
        pose.x += h * (v * std::cos(heading) - p.lateralPerRotation * w * std::sin(heading));
        pose.y += h * (v * std::sin(heading) + p.lateralPerRotation * w * std::cos(heading));
        pose.heading += w * h;
        u = next;
    }
    return {pose, u};
}

KinematicParameters randomParameters(std::uint32_t robot) {
    const auto draw = [&](std::uint32_t channel) { return uniformNoise({5, 0, robot, channel}); };
    KinematicParameters p;
    p.v = {draw(0) * 0.3, draw(1) < 0.2 ? 0.003 : draw(1) * 0.2, 0.9, 0.01, 0.5, draw(2) < 0.5 ? 0 : 3 * draw(2)};
    p.w = {draw(3) * 0.3, draw(4) * 0.2, 1.1, 0.02, draw(5) < 0.5 ? 0 : 1.7, draw(6) < 0.5 ? 0 : 8 * draw(6)};
    p.lateralPerRotation = draw(7) * 0.05;
    // Whole microseconds, which are the steps of brute force.
    p.v.deadTime = std::round(p.v.deadTime * 1e6) * 1e-6;
    p.w.deadTime = std::round(p.w.deadTime * 1e6) * 1e-6;
    return p;
}

CommandHistory randomHistory(std::uint32_t robot) {
    CommandHistory history;
    for (int i = 0; i < 60; ++i) {
        const auto draw = [&](std::uint32_t channel) { return 2 * uniformNoise({6, i, robot, channel}) - 1; };
        history.issue((i - 58) * 17 * ms, i % 7 == 3 ? Command{} : Command{0.6 * draw(0), 2 * draw(1)});
    }
    return history;
}

TEST(Kinematic, AgreesWithBruteForceIntegration) {
    for (std::uint32_t robot = 0; robot < 24; ++robot) {
        const KinematicParameters parameters = randomParameters(robot);
        const CommandHistory history = randomHistory(robot);
        const MotionInput input{&history, 0, {0.2, -0.4}};
        const MotionStep exact = KinematicModel(parameters).predictOne(input), brute = bruteForce(parameters, input);
        // Brute force itself is wrong by up to a step where a ramp ends.
        EXPECT_NEAR(exact.increment.x, brute.increment.x, 1e-9) << robot;
        EXPECT_NEAR(exact.increment.y, brute.increment.y, 1e-9) << robot;
        EXPECT_NEAR(exact.increment.heading, brute.increment.heading, 1e-8) << robot;
        EXPECT_NEAR(exact.velocity.v, brute.velocity.v, 1e-6) << robot;
        EXPECT_NEAR(exact.velocity.w, brute.velocity.w, 1e-5) << robot;
    }
}

TEST(Kinematic, PeriodInOnePieceEqualsItsParts) {
    const KinematicParameters parameters = randomParameters(99);
    CommandHistory history;
    history.issue(-300 * ms, {0.4, 1});
    history.issue(-95 * ms, {-0.2, -1.5});
    const MotionStep whole = KinematicModel(parameters).predictOne({&history, 0, {0.1, 0}});
    const KinematicModel part(parameters, 12'500'000);
    MotionStep parts{{}, {0.1, 0}};
    for (int i = 0; i < 8; ++i) {
        const MotionStep next = part.predictOne({&history, i * 12'500'000, parts.velocity});
        parts = {parts.increment * next.increment, next.velocity};
    }
    EXPECT_NEAR(whole.increment.x, parts.increment.x, 1e-14);
    EXPECT_NEAR(whole.increment.y, parts.increment.y, 1e-14);
    EXPECT_NEAR(whole.velocity.w, parts.velocity.w, 1e-13);
}

TEST(Kinematic, BatchGivesTheSameBitsAsAlone) {
    std::vector<CommandHistory> histories;
    for (std::uint32_t i = 0; i < 9; ++i) histories.push_back(randomHistory(i));
    const KinematicModel model(randomParameters(1));
    std::vector<MotionInput> inputs;
    for (const auto& history : histories) inputs.push_back({&history, 3 * ms, {0.3, 0.1}});
    std::vector<MotionStep> steps(inputs.size());
    model.predict(inputs, steps);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        EXPECT_EQ(steps[i].increment, model.predictOne(inputs[i]).increment);
        EXPECT_EQ(steps[i].velocity, model.predictOne(inputs[i]).velocity);
    }
}

}  // namespace
}  // namespace mrose
