#include "logs/pose_grid.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "logs/log_reader.h"
#include "support/test_data.h"
#include "support/units.h"

namespace mrose {
namespace {

/// 30 s of commands and noisy poses at irregular milliseconds, with pauses of 0.15 and 0.35 s in the poses.
Trajectory irregular(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0, 1e-3);
    Trajectory trajectory;
    const Nanoseconds origin = 1'248'444'187'003 * ms;
    for (Nanoseconds t = 437; t < 30'000; t += 10 + static_cast<Nanoseconds>(random() % 12))
        trajectory.commands.push_back({origin + t * ms, {0.1, 0.2}});
    for (Nanoseconds t = 0; t < 31'000; t += 11 + static_cast<Nanoseconds>(random() % 15)) {
        if (t > 9'000 && t < 9'140) t += 150;
        if (t > 17'000 && t < 17'300) t += 350;
        const double s = static_cast<double>(t) * 1e-3;
        trajectory.poses.push_back(
            {origin + t * ms, {std::cos(s) + noise(random), std::sin(s) + noise(random), 0.7 * s + noise(random)}});
    }
    return trajectory;
}

struct PlainLine {
    Pose value, slope;
};

/// The definition in its plainest form: normal equations over all samples, for every instant anew.
PlainLine plainFit(const std::vector<StampedPose>& poses, Nanoseconds time) {
    double n = 0, st = 0, stt = 0;
    Pose s, stp;
    for (const auto& [stamp, pose] : poses) {
        if (stamp < time - 60 * ms || stamp >= time + 60 * ms) continue;
        const double t = static_cast<double>(stamp - time) / 1e9;
        n += 1, st += t, stt += t * t;
        s = {s.x + pose.x, s.y + pose.y, s.heading + pose.heading};
        stp = {stp.x + t * pose.x, stp.y + t * pose.y, stp.heading + t * pose.heading};
    }
    if (n >= 4) {
        const double d = n * stt - st * st;
        return {{(stt * s.x - st * stp.x) / d, (stt * s.y - st * stp.y) / d, (stt * s.heading - st * stp.heading) / d},
                {(n * stp.x - st * s.x) / d, (n * stp.y - st * s.y) / d, (n * stp.heading - st * s.heading) / d}};
    }
    std::size_t after = 1;
    while (poses[after].time < time) ++after;
    const StampedPose &a = poses[after - 1], &b = poses[after];
    const double since = static_cast<double>(time - a.time) / 1e9, whole = static_cast<double>(b.time - a.time) / 1e9;
    const Pose slope{(b.pose.x - a.pose.x) / whole, (b.pose.y - a.pose.y) / whole,
                     (b.pose.heading - a.pose.heading) / whole};
    return {{a.pose.x + since * slope.x, a.pose.y + since * slope.y, a.pose.heading + since * slope.heading}, slope};
}

TEST(PoseGrid, IsTheLineFittedOver60MillisecondsOnBothSides) {
    const Trajectory trajectory = irregular(1);
    const PoseGrid grid = poseGrid(trajectory);
    ASSERT_GT(grid.size(), 250u);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        const auto [value, slope] = plainFit(trajectory.poses, grid.time(i));
        EXPECT_NEAR(grid.poses[i].x, value.x, 1e-10) << i;
        EXPECT_NEAR(grid.poses[i].y, value.y, 1e-10) << i;
        EXPECT_NEAR(grid.poses[i].heading, value.heading, 1e-10) << i;
        const double forward = std::cos(value.heading) * slope.x + std::sin(value.heading) * slope.y;
        EXPECT_NEAR(grid.velocities[i].v, forward, 1e-8) << i;
        EXPECT_NEAR(grid.velocities[i].w, slope.heading, 1e-8) << i;
    }
}

TEST(PoseGrid, IsNotOkWithinAGapOfTheTruth) {
    const Trajectory trajectory = irregular(2);
    const PoseGrid grid = poseGrid(trajectory);
    std::size_t bad = 0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
        bool expected = true;
        for (std::size_t k = 1; k < trajectory.poses.size(); ++k)
            if (trajectory.poses[k - 1].time < grid.time(i) && trajectory.poses[k].time >= grid.time(i))
                expected = trajectory.poses[k].time - trajectory.poses[k - 1].time < 200 * ms;
        EXPECT_EQ(grid.ok[i], expected) << i;
        bad += !grid.ok[i];
    }
    EXPECT_GE(bad, 3u);
}

TEST(PoseGrid, LiesOnWholeStepsFromAfterTheStartToBeforeTheEnd) {
    const Trajectory trajectory = irregular(3);
    for (const Nanoseconds step : {100 * ms, 20 * ms})
        for (const GridMargins margins : {GridMargins{}, GridMargins{0, 0}, GridMargins{2000 * ms, 0}}) {
            const Nanoseconds begin = trajectory.commands.front().time + margins.begin;
            const Nanoseconds end = trajectory.commands.back().time - margins.end;
            const PoseGrid grid = poseGrid(trajectory, step, margins);
            EXPECT_EQ(grid.start % step, 0);
            EXPECT_GE(grid.start, begin);
            EXPECT_LT(grid.start - step, begin);
            EXPECT_LT(grid.time(grid.size() - 1), end);
            EXPECT_GE(grid.time(grid.size()), end);
            EXPECT_EQ(grid.ok.size(), grid.size());
            EXPECT_EQ(grid.velocities.size(), grid.size());
        }
}

TEST(PoseGrid, DefaultMarginsAreThoseOfTheReferee) {
    EXPECT_EQ(GridMargins{}.begin, 1500 * ms);
    EXPECT_EQ(GridMargins{}.end, 1000 * ms);
}

TEST(PoseGrid, IsEmptyWithoutCommandsOrTruthOrTime) {
    Trajectory trajectory = irregular(4);
    Trajectory blind = trajectory, silent = trajectory;
    blind.poses.clear();
    silent.commands.clear();
    trajectory.commands.resize(5);
    for (const auto& item : {blind, silent, trajectory, Trajectory{}}) EXPECT_EQ(poseGrid(item).size(), 0u);
}

Trajectory arc(double v, double w, Nanoseconds period) {
    Trajectory trajectory;
    for (Nanoseconds t = 0; t <= 2000 * ms; t += period)
        trajectory.poses.push_back({t, exp({v * toSeconds(t), 0, w * toSeconds(t)})});
    return trajectory;
}

TEST(PoseGrid, IsEmptyWhereTheLogCannotFillIt) {
    Trajectory trajectory;
    const auto last = [&](Nanoseconds time) -> const Trajectory& {
        trajectory.commands = {{0, {0.1, 0}}, {time, {0.1, 0}}};
        trajectory.poses = {{0, {}}, {time, {1, 0, 0}}};
        return trajectory;
    };
    constexpr Nanoseconds day = 24 * 3600 * nanosecondsPerSecond, year = 365 * day;
    EXPECT_EQ(poseGrid(last(day)).size(), 863'975u) << "a pause";
    EXPECT_EQ(poseGrid(last(year)).size(), 0u);
    EXPECT_EQ(poseGrid(last(100 * year), 10 * ms).size(), 0u);
}

TEST(MeasuredStart, FindsPoseAndVelocityOfASteadyRobotAlsoBetweenSamples) {
    const Trajectory trajectory = arc(0.3, 0.5, 15 * ms);
    for (const Nanoseconds time : {1000 * ms, 1007 * ms, 1999 * ms}) {
        const MeasuredStart start = measuredStart(trajectory, time);
        ASSERT_TRUE(start.valid);
        const Pose expected = exp({0.3 * toSeconds(time), 0, 0.5 * toSeconds(time)});
        EXPECT_NEAR(start.pose.x, expected.x, 1e-3);
        EXPECT_NEAR(start.pose.y, expected.y, 1e-3);
        EXPECT_NEAR(start.pose.heading, expected.heading, 1e-9);
        EXPECT_NEAR(start.velocity.velocity.v, 0.3, 2e-3);
        EXPECT_NEAR(start.velocity.velocity.w, 0.5, 1e-9);
    }
}

TEST(VelocityAt, IsThatOfTheGridAndOnlyFromBothSides) {
    const Trajectory trajectory = irregular(6);
    const PoseGrid grid = poseGrid(trajectory);
    ASSERT_GT(grid.size(), 20u);
    for (std::size_t i = 0; i < grid.size(); ++i) {
        const auto velocity = velocityAt(trajectory.poses, grid.time(i));
        if (!grid.ok[i]) {
            EXPECT_FALSE(velocity) << i;
        } else if (velocity) {
            EXPECT_EQ(*velocity, grid.velocities[i]) << i;
        }
    }
    // A robot that begins to turn at 1 s: before it, the truth up to then knows nothing of it.
    Trajectory turning = arc(0.3, 0, 15 * ms);
    for (StampedPose& pose : turning.poses)
        if (pose.time > 1000 * ms) pose.pose.heading = toSeconds(pose.time - 1000 * ms);
    EXPECT_NEAR(measuredStart(turning, 1000 * ms).velocity.velocity.w, 0, 1e-9);
    EXPECT_NEAR(velocityAt(turning.poses, 1000 * ms)->w, 0.5, 0.1);
    EXPECT_NEAR(velocityAt(turning.poses, 1100 * ms)->w, 1, 1e-9);
    EXPECT_FALSE(velocityAt(turning.poses, 50 * ms)) << "one-sided";
    EXPECT_FALSE(velocityAt(turning.poses, turning.poses.back().time - 50 * ms));
    EXPECT_FALSE(velocityAt({}, 0));
}

TEST(MeasuredStart, ReadsNothingLater) {
    const Trajectory whole = irregular(5);
    for (const std::size_t last : {100u, 400u, 800u}) {
        Trajectory cut = whole;
        cut.poses.resize(last + 1);
        for (const Nanoseconds later : {Nanoseconds{0}, 3 * ms}) {
            const Nanoseconds time = whole.poses[last].time + later;
            const MeasuredStart a = measuredStart(whole, time), b = measuredStart(cut, time);
            ASSERT_TRUE(a.valid);
            EXPECT_EQ(a.pose, b.pose);
            EXPECT_EQ(a.velocity.velocity, b.velocity.velocity);
            EXPECT_EQ(a.velocity.time, b.velocity.time);
        }
    }
}

TEST(MeasuredStart, IsNotValidWhereTheTruthIsOldOrMissing) {
    const Trajectory trajectory = arc(0.3, 0.5, 15 * ms);
    const Nanoseconds last = trajectory.poses.back().time;
    EXPECT_TRUE(measuredStart(trajectory, last + 200 * ms).valid);
    EXPECT_FALSE(measuredStart(trajectory, last + 201 * ms).valid);
    EXPECT_FALSE(measuredStart(trajectory, -1).valid);
    EXPECT_FALSE(measuredStart(Trajectory{}, 0).valid);
}

TEST(MeasuredStart, FewSamplesAfterAGapReachBehindIt) {
    Trajectory trajectory = arc(0.3, 0.5, 15 * ms);
    std::erase_if(trajectory.poses,
                  [](const StampedPose& sample) { return sample.time > 700 * ms && sample.time < 990 * ms; });
    const MeasuredStart start = measuredStart(trajectory, 1010 * ms);  // two samples after the gap
    ASSERT_TRUE(start.valid);
    EXPECT_NEAR(start.velocity.velocity.w, 0.5, 1e-9);
}

/// The bounds that the choice of the estimator was made for; twice what was measured for single windows to differ.
TEST(MeasuredStart, IsNearTheCentredFitOnRealLogs) {
    const auto data = realData();
    if (!data || !std::filesystem::exists(*data / "mrclam" / "MRCLAM_Dataset6"))
        GTEST_SKIP() << "no real logs: set MROSE_DATA";
    const auto log = readLog(*data / "mrclam" / "MRCLAM_Dataset6");
    ASSERT_TRUE(log) << log.error().message();
    for (const RobotLog& robot : log->robots) {
        const Trajectory& trajectory = robot.trajectories[0];
        const PoseGrid grid = poseGrid(trajectory);
        double squares = 0, distance = 0;
        std::size_t count = 0;
        for (std::size_t i = 5; i + 5 < grid.size(); ++i) {
            const MeasuredStart start = measuredStart(trajectory, grid.time(i));
            if (!std::all_of(grid.ok.begin() + static_cast<std::ptrdiff_t>(i) - 5,
                             grid.ok.begin() + static_cast<std::ptrdiff_t>(i) + 6, [](bool ok) { return ok; }))
                continue;
            ASSERT_TRUE(start.valid);
            squares += std::pow(start.pose.heading - grid.poses[i].heading, 2);
            distance += std::pow(std::hypot(start.pose.x - grid.poses[i].x, start.pose.y - grid.poses[i].y), 2);
            ++count;
        }
        EXPECT_LT(std::sqrt(squares / static_cast<double>(count)), 6e-3) << robot.robot;     // rad
        EXPECT_LT(std::sqrt(distance / static_cast<double>(count)), 1.2e-3) << robot.robot;  // m
    }
}

}  // namespace
}  // namespace mrose
