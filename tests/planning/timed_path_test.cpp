#include "planning/timed_path.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "planning/planning_worlds.h"

namespace mrose {
namespace {

TEST(TimedPath, TurnsDrivesAndHolds) {
    const DriveTimes drive{.heading = 0, .speed = 0.5, .rotation = 2, .begin = 1};
    const TimedPath path = timedPath({{0, 0}, {1, 0}, {1, 2}}, drive);
    EXPECT_DOUBLE_EQ(path.arrival(), 1 + 2 + std::numbers::pi / 4 + 4);
    EXPECT_EQ(path.at(0), (Point{0, 0}));
    EXPECT_NEAR(path.at(2).x, 0.5, 1e-12);
    EXPECT_EQ(path.at(3.5), (Point{1, 0}));
    EXPECT_EQ(path.at(99), (Point{1, 2}));
    const TimedPath held = timedPath({{0, 0}, {1, 0}, {1, 2}}, drive, {0.25, 3});
    EXPECT_DOUBLE_EQ(held.arrival(), path.arrival() + 3);
    EXPECT_NEAR(held.at(2.5).x, 0.25, 1e-12);
    EXPECT_NEAR(held.at(4.4).x, 0.25, 1e-12);
    EXPECT_NEAR(held.at(5).x, 0.5, 1e-12);
    EXPECT_DOUBLE_EQ(timedPath({{0, 0}, {1, 0}}, drive, {0, 3}).at(3.9).x, 0);
}

/// Two that cross at right angles: nearer than s from sqrt(2) (t) and on, by hand.
TEST(TimedPath, ConflictOfACrossingIsThatOfTheClosedForm) {
    const TimedPath one{{{{-2, 0}, 0}, {{2, 0}, 4}}}, two{{{{0, -2}, 0}, {{0, 2}, 4}}};
    const auto conflict = firstConflict(one, two, 0.5);
    ASSERT_TRUE(conflict);
    EXPECT_NEAR(conflict->begin, 2 - 0.5 / std::numbers::sqrt2, 1e-12);
    EXPECT_NEAR(conflict->end, 2 + 0.5 / std::numbers::sqrt2, 1e-12);
    EXPECT_NEAR(conflict->mine.x, -0.5 / std::numbers::sqrt2, 1e-12);
    EXPECT_NEAR(conflict->other.y, -0.5 / std::numbers::sqrt2, 1e-12);
    const TimedPath later{{{{0, -2}, 1}, {{0, 2}, 5}}};
    EXPECT_FALSE(firstConflict(one, later, 0.5));
}

TEST(TimedPath, WhoStandsInTheWayConflictsForEverAndWhoPartsDoesNot) {
    const TimedPath moving{{{{-2, 0}, 0}, {{0, 0}, 2}}}, standing{{{{0.3, 0}, 0}}};
    const auto conflict = firstConflict(moving, standing, 0.5);
    ASSERT_TRUE(conflict);
    EXPECT_NEAR(conflict->begin, 1.8, 1e-12);
    EXPECT_TRUE(std::isinf(conflict->end));
    const TimedPath away{{{{0.1, 0}, 0}, {{-2, 0}, 2}}};
    EXPECT_FALSE(firstConflict(away, standing, 0.5));
    EXPECT_FALSE(firstConflict(standing, standing, 0.5));
}

TEST(TimedPath, LeastDistanceOfACrossingIsThatOfTheClosedForm) {
    const TimedPath one{{{{-2, 0}, 0}, {{2, 0}, 4}}}, later{{{{0, -2}, 1}, {{0, 2}, 5}}};
    EXPECT_NEAR(leastDistance(one, later), 1 / std::numbers::sqrt2, 1e-12);
    const TimedPath standing{{{{3, 0.5}, 0}}};
    EXPECT_NEAR(leastDistance(one, standing), std::hypot(1, 0.5), 1e-12) << "at the end of its way";
    EXPECT_EQ(leastDistance(standing, standing), 0);
}

TEST(TimedPath, ConflictsAreThoseOfSampledMotion) {
    int conflicts = 0;
    for (std::int64_t trial = 0; trial < 300; ++trial) {
        const auto drawn = [&](std::uint32_t part) {
            std::vector<Point> points;
            for (std::uint32_t i = 0; i < 4; ++i)
                points.push_back(
                    {drawnNumber(41, trial, part + 2 * i, 0, 5), drawnNumber(41, trial, part + 2 * i + 1, 0, 3)});
            return timedPath(points, {.heading = drawnNumber(41, trial, part + 20, -3, 3), .speed = 0.4, .rotation = 1},
                             {1.0, drawnNumber(41, trial, part + 21, 0, 3)});
        };
        const TimedPath one = drawn(0), two = drawn(100);
        double sampled = -1, last = 0, least = distance(one.at(0), two.at(0));
        for (double t = 0; t < 60; t += 0.005) {
            const double far = distance(one.at(t), two.at(t));
            if (sampled < 0 && far < 0.6 && far < last) sampled = t;
            last = far;
            least = std::min(least, far);
        }
        EXPECT_NEAR(leastDistance(one, two), least, 0.004) << trial;
        const auto conflict = firstConflict(one, two, 0.6);
        if (conflict) {
            ++conflicts;
            EXPECT_LT(distance(conflict->mine, conflict->other), 0.6 + 1e-9);
            EXPECT_NEAR(conflict->begin, std::max(0.0, sampled), 0.02) << trial;
        } else {
            EXPECT_LT(sampled, 0) << trial;
        }
    }
    EXPECT_GT(conflicts, 60);
    EXPECT_LT(conflicts, 290);
}

}  // namespace
}  // namespace mrose
