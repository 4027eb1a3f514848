#include "logs/looks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mrose {
namespace {

using testing::ElementsAre;

constexpr Nanoseconds millisecond = 1'000'000;

std::vector<Nanoseconds> timesOf(const std::vector<Look>& looks) {
    std::vector<Nanoseconds> times;
    for (const Look& look : looks) times.push_back(look.time / millisecond);
    return times;
}

std::vector<Look> looksAt(const std::vector<Nanoseconds>& milliseconds) {
    std::vector<Look> looks;
    for (const Nanoseconds time : milliseconds) looks.push_back({time * millisecond, {}});
    return looks;
}

TEST(Looks, StampsShortlyAfterTheFirstOfALookAreOfIt) {
    SensorDefects found;
    const LogReading a{0, 1, 0.1}, b{1, 2, 0.2}, c{2, 3, 0.3};
    const auto looks =
        joinLooks({{0, a}, {millisecond, b}, {50 * millisecond, c}, {51 * millisecond, a}}, 50 * millisecond, found);
    ASSERT_THAT(timesOf(looks), ElementsAre(0, 51));
    EXPECT_THAT(looks[0].readings, ElementsAre(a, b, c));
    EXPECT_THAT(looks[1].readings, ElementsAre(a));
    EXPECT_EQ(found.joinedStamps, 2);
    EXPECT_EQ(found.outOfOrder, 0);
}

TEST(Looks, OfASubjectsReadingsInOneLookTheLastIsKept) {
    SensorDefects found;
    const auto looks =
        joinLooks({{0, LogReading{4, 1, 0.1}}, {0, LogReading{5, 2, 0}}, {0, LogReading{4, 3, 0.2}}}, 0, found);
    ASSERT_EQ(looks.size(), 1u);
    EXPECT_THAT(looks[0].readings, ElementsAre(LogReading{4, 3, 0.2}, LogReading{5, 2, 0}));
    EXPECT_EQ(found.repeated, 1);
}

TEST(Looks, RowsOutOfOrderAreSortedAndRowsWithoutAReadingAreLooksAllTheSame) {
    SensorDefects found;
    const auto looks = joinLooks({{9 * millisecond, {}}, {3 * millisecond, LogReading{}}}, 0, found);
    ASSERT_THAT(timesOf(looks), ElementsAre(3, 9));
    EXPECT_TRUE(looks[1].readings.empty());
    EXPECT_EQ(found.outOfOrder, 1);
}

TEST(Looks, BetweenThoseThatAreWholePeriodsApartItLookedInVain) {
    SensorDefects found;
    auto looks = looksAt({0, 236, 708, 1000, 2928});  // 1, 2, 1.24 and 8.17 periods
    addEmptyLooks(looks, 0.236, found);
    EXPECT_THAT(timesOf(looks), ElementsAre(0, 236, 472, 708, 1000, 1241, 1482, 1723, 1964, 2205, 2446, 2687, 2928));
    EXPECT_EQ(found.emptyLooks, 8);
}

TEST(Looks, TooFarApartOrOutOfStepNothingIsKnownBetween) {
    SensorDefects found;
    auto looks = looksAt({0, 9 * 236, 9 * 236 + 500});  // 9 periods; 2 of 250 ms
    addEmptyLooks(looks, 0.236, found);
    EXPECT_THAT(timesOf(looks), ElementsAre(0, 2124, 2624));
    EXPECT_EQ(found.emptyLooks, 0);
}

TEST(Looks, ReadingsOfAnotherTimeThanTheRobotsAreRecognised) {
    Trajectory trajectory;
    trajectory.commands = {{0, {}}, {10 * nanosecondsPerSecond, {}}};
    trajectory.poses = {{5 * nanosecondsPerSecond, {}}, {12 * nanosecondsPerSecond, {}}};
    const auto between = [](Nanoseconds first, Nanoseconds last) {
        return SensorLog{"camera", {{first * nanosecondsPerSecond, {}}, {last * nanosecondsPerSecond, {}}}};
    };
    EXPECT_TRUE(sharesTime(between(11, 40), trajectory));
    EXPECT_TRUE(sharesTime(between(-5, 0), trajectory));
    EXPECT_FALSE(sharesTime(between(13, 40), trajectory));
    EXPECT_FALSE(sharesTime(between(-5, -1), trajectory));
    EXPECT_TRUE(sharesTime(SensorLog{}, trajectory));
    EXPECT_EQ(otherTimeCause(between(13, 40), trajectory),
              "readings from 13.000 to 40.000 s; expected some within the robot's commands and poses, 0.000 to 12.000 "
              "s");
}

}  // namespace
}  // namespace mrose
