#include "assessment/floor.h"

#include <gtest/gtest.h>

#include "assessment/test_models.h"

namespace mrose {
namespace {

Command drive(double t) { return {0.2, t < 5 ? 0.0 : 0.3}; }

Trajectory run(const std::string& name, Command (*commandAt)(double), double realGain = 1) {
    Trajectory trajectory = obedientTrajectory(0, 12 * second, commandAt);
    trajectory.name = name;
    const Pose origin = trajectory.poses.front().pose;
    for (StampedPose& p : trajectory.poses) {
        p.pose.x = origin.x + realGain * (p.pose.x - origin.x);
        p.pose.y = origin.y + realGain * (p.pose.y - origin.y);
    }
    return trajectory;
}

TEST(Floor, EqualOutcomesOfEqualCommandsLeaveNothing) {
    const Floor floor = findFloor(logOf({run("a", drive), run("b", drive)}), {}, {});
    ASSERT_EQ(floor.pairs.size(), 1u);
    EXPECT_EQ(floor.tried, 2u);
    EXPECT_EQ(floor.horizon, 10 * second);
    EXPECT_NEAR(floor.spread.p, 0, 1e-9);
    EXPECT_NEAR(floor.spread.hd, 0, 1e-9);
    EXPECT_NEAR(floor.pairs[0].commandDifference, 0, 1e-12);
}

TEST(Floor, OutcomesOfOtherSizeDifferByTheirClosedForm) {
    const auto straight = [](double) { return Command{0.2, 0}; };
    const Floor floor = findFloor(logOf({run("a", straight), run("b", straight, 1.1)}), {}, {});
    ASSERT_EQ(floor.pairs.size(), 1u);
    // 0.02 m/s apart, mean over 0.1 ... 10 s; the paths are 2 and 2.2 m.
    EXPECT_NEAR(floor.spread.p, 100 * 0.02 * 5.05 / 2.1, 1e-9);
    EXPECT_NEAR(floor.best.p, floor.spread.p / std::sqrt(2), 1e-12);
    EXPECT_NEAR(floor.pairs[0].positionFinal, 0.2, 1e-9);
}

TEST(Floor, CountsNoPairBeyondTheBounds) {
    const auto other = [](double t) { return Command{0.2, t < 5 ? 0.0 : 0.304}; };
    const Log log = logOf({run("a", drive), run("b", other)});
    // 7 s at 4 mrad/s: 28 mrad apart at the end.
    EXPECT_EQ(findFloor(log, {}, {}, {.rotationBound = 0.0279}).pairs.size(), 0u);
    EXPECT_EQ(findFloor(log, {}, {}, {.rotationBound = 0.0281}).pairs.size(), 1u);
    EXPECT_TRUE(std::isnan(findFloor(log, {}, {}, {.rotationBound = 0.0279}).spread.p));
}

TEST(Floor, ADifferenceThatCancelsByTheEndCountsToo) {
    const auto detour = [](double t) { return Command{t > 4 && t < 6 ? 0.25 : t > 6 && t < 8 ? 0.15 : 0.2, 0}; };
    const auto straight = [](double) { return Command{0.2, 0}; };
    const Log log = logOf({run("a", straight), run("b", detour)});
    EXPECT_EQ(findFloor(log, {}, {}, {.pathBound = 0.08}).pairs.size(), 0u);
    EXPECT_EQ(findFloor(log, {}, {}, {.pathBound = 0.12}).pairs.size(), 1u);
}

TEST(Floor, PairsShareNoInstantAndTakeTheBestMatchFirst) {
    // One long straight run: every stretch matches every other one.
    const auto straight = [](double) { return Command{0.2, 0}; };
    const Floor floor = findFloor(logOf({obedientTrajectory(0, 64 * second, straight)}), {}, {});
    EXPECT_GT(floor.candidates, 1000u);
    ASSERT_GE(floor.pairs.size(), 1u);
    std::vector<Nanoseconds> starts;
    for (const FloorPair& pair : floor.pairs) {
        starts.push_back(pair.first.start);
        starts.push_back(pair.second.start);
    }
    std::sort(starts.begin(), starts.end());
    for (std::size_t i = 1; i < starts.size(); ++i) EXPECT_GE(starts[i] - starts[i - 1], 10 * second);

    const auto slightlyOther = [](double) { return Command{0.2, 0.001}; };
    const Floor chosen = findFloor(logOf({run("a", straight), run("b", slightlyOther), run("c", straight)}), {}, {});
    ASSERT_EQ(chosen.pairs.size(), 1u);
    EXPECT_EQ(chosen.candidates, 3u);
    EXPECT_NEAR(chosen.pairs[0].commandDifference, 0, 1e-12);
}

TEST(Floor, PutsModelsBesideItOnTheSameStretches) {
    const auto straight = [](double) { return Command{0.2, 0}; };
    const HeldCommandModel model{second / 10, 1.05};
    const NamedModel named = NamedModel::same("fast", model);
    const auto evaluation = evaluate(logOf({run("a", straight), run("b", straight, 1.1)}), {&named, 1});
    ASSERT_TRUE(evaluation);
    ASSERT_TRUE(evaluation->log.floor && evaluation->log.turningFloor);
    // 0.01 m/s off on either side, and on the other one's scale.
    EXPECT_NEAR(evaluation->models[0].onFloor.p, 100 * 0.01 * 5.05 / 2.1, 1e-6);
    EXPECT_TRUE(evaluation->log.turningFloor->pairs.empty());
    EXPECT_TRUE(std::isnan(evaluation->models[0].onTurningFloor.p));
}

}  // namespace
}  // namespace mrose
