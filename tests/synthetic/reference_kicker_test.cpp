#include "synthetic/reference_kicker.h"

#include <cmath>

#include <gtest/gtest.h>

#include "logs/csv_reader.h"
#include "logs/csv_writer.h"
#include "synthetic/ball_play.h"
#include "synthetic/field_landmarks.h"

namespace mrose {
namespace {

Point onFace(double gap, double side) {
    const ReferenceKickerParameters p;
    return {p.face + p.ballRadius + gap, side};
}

/// Of kicks 0 to count, each with its mean.
struct MeanAndSpread {
    double mean = 0, spread = 0;
};
template <class Value>
MeanAndSpread over(int count, const Value& value) {
    MeanAndSpread of;
    for (int i = 0; i < count; ++i) of.mean += value(i) / count;
    for (int i = 0; i < count; ++i) of.spread += std::pow(value(i) - of.mean, 2) / count;
    of.spread = std::sqrt(of.spread);
    return of;
}

TEST(ReferenceKicker, DelaysScatterAsTheirPartsSay) {
    const ReferenceKicker kicker(3);
    const ReferenceKickerParameters& p = kicker.parameters();
    const auto half = over(4000, [&](int i) { return kicker.delay(0.5, i); });
    EXPECT_NEAR(half.mean, p.deadTime + p.slowStart / 2 + p.poll / 2 + p.deadTimeTail, 5e-4);
    EXPECT_NEAR(half.spread, std::hypot(p.poll / std::sqrt(12.0), p.deadTimeTail), 3e-4);
    EXPECT_LT(kicker.delay(1, 7), kicker.delay(0.2, 7));
}

TEST(ReferenceKicker, IsUnevenRunsDownAndIsNoMultipleOfPower) {
    const ReferenceKicker kicker(3);
    const auto speedAt = [&](double power, double side, int from) {
        return over(
                   400,
                   [&](int i) { return length(kicker.strike(power, onFace(0.01, side), {}, from + 250 * i).velocity); })
            .mean;
    };
    const double full = speedAt(1, 0, 0);
    EXPECT_NEAR(full, 4.2 * (1 - 2.5 * 0.01), 0.03);
    EXPECT_NEAR(speedAt(0.5, 0, 0) / full, std::pow(0.5, 0.8), 0.01);
    EXPECT_LT(speedAt(1, 0.08, 0), 0.87 * full);
    EXPECT_NEAR(speedAt(1, 0.05, 0) - speedAt(1, -0.05, 0), 4.2 * 0.975 * 2 * 0.05 * std::sin(42 * 0.05), 0.05);
    EXPECT_NEAR(speedAt(1, 0, 249) / full, 1 - 0.1 * 249 / 250, 0.01);
    const auto aside =
        over(2000, [&](int i) { return direction(kicker.strike(1, onFace(0.01, 0.09), {}, i).velocity); });
    EXPECT_NEAR(aside.mean, 1.6 * 0.09 + 0.02 + 0.05 * std::sin(35 * 0.09 + 0.4), 3e-3);
    EXPECT_NEAR(aside.spread, 0.012 + 0.03 * std::pow(0.09 / 0.11, 2), 2e-3);
}

TEST(ReferenceKicker, MissesWhatLiesBeyondItsFace) {
    const ReferenceKicker kicker(3);
    const auto hits = [&](double gap, double side) {
        return over(200, [&](int i) { return kicker.strike(1, onFace(gap, side), {}, i).hit ? 1.0 : 0.0; }).mean;
    };
    EXPECT_NEAR(hits(0.03, 0.05), 1, 1e-9);
    EXPECT_EQ(hits(0.08, 0.05), 0);
    EXPECT_EQ(hits(0.03, -0.13), 0);
    EXPECT_NEAR(hits(0.06, 0), 0.5, 0.15);
}

TEST(ReferenceKicker, AMovingRobotTakesTheBallAlong) {
    const ReferenceKicker kicker(3);
    const Point ball = onFace(0.02, 0.04);
    const Point still = kicker.strike(0.7, ball, {}, 5).velocity;
    const Point moving = kicker.strike(0.7, ball, {0.3, 0.5}, 5).velocity;
    EXPECT_NEAR(moving.x - still.x, 0.3 - 0.5 * 0.04, 1e-12);
    EXPECT_NEAR(moving.y - still.y, 0.6 * 0.5 * (0.225 + 0.02), 1e-12);
}

TEST(BallPlay, TheBallLiesThereUntilTheKickMeetsIt) {
    int hits = 0;
    for (int i = 0; i < 12; ++i) {
        const BallRun run = playBall(BallPlay::kicks, 4, 100 + static_cast<std::uint64_t>(i), i);
        ASSERT_EQ(run.kicks.size(), 1u);
        ASSERT_EQ(run.truth.departures.size(), 1u);
        const BallTruth::Departure& left = run.truth.departures[0];
        const Nanoseconds at = run.kicks[0].time + fromSeconds(left.delay);
        const auto& path = run.truth.path;
        const auto step = static_cast<std::size_t>(at / ReferenceRobot::step);
        EXPECT_EQ(path[step].place, path[0].place);
        hits += left.hit ? 1 : 0;
        if (!left.hit) continue;
        const Point way = path[step + 5].place - path[step].place;
        EXPECT_NEAR(length(way) / 0.01, length(left.velocity), 0.05);
    }
    EXPECT_GE(hits, 6);
    EXPECT_LT(hits, 12);
}

TEST(BallPlay, BouncesLoseWhatTheHallSaysAndTheBallStaysWithin) {
    int walls = 0, robots = 0;
    for (int i = 0; i < 25; ++i) {
        const BallRun run = playBall(BallPlay::throws, 5, 300 + static_cast<std::uint64_t>(i), i);
        for (const BallTruth::Bounce& bounce : run.truth.bounces) {
            EXPECT_NEAR(bounce.parting, hallRestitution(bounce.robot, bounce.approach) * bounce.approach, 1e-12);
            (bounce.robot ? robots : walls) += 1;
        }
        for (const StampedBall& at : run.truth.path)
            ASSERT_TRUE(at.place.x > 0.09 && at.place.x < syntheticFieldLength - 0.09 && at.place.y > 0.09 &&
                        at.place.y < syntheticFieldWidth - 0.09);
    }
    EXPECT_GE(walls, 3);
    EXPECT_GE(robots, 3);
}

TEST(BallPlay, TheTrackerSeesTheBallWithItsNoise) {
    const BallRun run = playBall(BallPlay::throws, 6, 9, 0);
    double squares = 0;
    for (const StampedBall& seen : run.ball) {
        const Point off = seen.place - run.truth.path[static_cast<std::size_t>(seen.time / ReferenceRobot::step)].place;
        squares += dot(off, off);
    }
    const auto n = static_cast<double>(run.ball.size());
    EXPECT_NEAR(std::sqrt(squares / (2 * n)), ballTrackerNoise, 1e-4);
    EXPECT_NEAR(n, 376 * (1 - ballTrackerMissing), 12);
}

TEST(BallPlay, LogsOfKicksAreTheSameForTheSameSeedAndReadBack) {
    const SyntheticPart part{.trajectories = 2, .ball = BallPlay::kicks};
    const std::string text = toCsv(generateLog(part, 4).value());
    EXPECT_EQ(text, toCsv(generateLog(part, 4).value()));
    EXPECT_NE(text, toCsv(generateLog(part, 5).value()));
    const auto log = parseCsv(text, "kicks.csv");
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_TRUE(log->synthetic);
    ASSERT_EQ(log->robots.at(0).trajectories.size(), 2u);
    const Trajectory& second = log->robots[0].trajectories[1];
    EXPECT_EQ(second.name, "kicks2");
    EXPECT_EQ(second.kicks.size(), 1u);
    EXPECT_GT(second.kicks[0].time, log->robots[0].trajectories[0].poses.back().time);
    EXPECT_EQ(log->robots[0].defects.ballOutliers, 0);
}

}  // namespace
}  // namespace mrose
