#include "logs/unit_doubts.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gmock/gmock.h>

#include "support/units.h"

namespace mrose {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// 60 s on a circle, 50 times a second, with units of its own.
Log circle(const std::function<void(StampedPose&)>& change, const std::string& format = "csv") {
    Log log;
    log.format = format;
    log.robots.push_back({"robot", {Trajectory{}}, {}});
    const double speed = 0.3, turning = 0.6;
    for (int i = 0; i < 3000; ++i) {
        const double time = 0.02 * i, heading = turning * time, radius = speed / turning;
        StampedPose stamped{i * 20 * ms, {radius * std::sin(heading), -radius * std::cos(heading), heading}};
        change(stamped);
        log.robots[0].trajectories[0].poses.push_back(stamped);
    }
    return log;
}

TEST(UnitDoubts, NoneInTheUnitsOfTheFormatHoweverOftenItHasTurned) {
    EXPECT_THAT(unitDoubts(circle([](StampedPose&) {})), IsEmpty());
    EXPECT_THAT(unitDoubts(circle([](StampedPose& stamped) { stamped.pose.heading += 1000; })), IsEmpty());
    EXPECT_THAT(unitDoubts(circle([](StampedPose& stamped) { stamped.time *= 5; })), IsEmpty()) << "10 a second";
    EXPECT_THAT(unitDoubts(Log{"", "csv", 0, {}, {}, false}), IsEmpty());
}

TEST(UnitDoubts, TimesInMillisecondsLeaveNothingToCompare) {
    EXPECT_THAT(unitDoubts(circle([](StampedPose& stamped) { stamped.time *= 1000; })),
                ElementsAre(testing::AllOf(HasSubstr("are 20 s apart"), HasSubstr("in seconds"))));
}

TEST(UnitDoubts, HeadingsInDegrees) {
    const auto inDegrees = [](StampedPose& stamped) { stamped.pose.heading *= 180 / std::numbers::pi; };
    EXPECT_THAT(unitDoubts(circle(inDegrees)), ElementsAre(HasSubstr("in radians, not in degrees")));
    EXPECT_THAT(unitDoubts(circle(inDegrees, "mrclam")), IsEmpty()) << "the format has its units";
}

TEST(UnitDoubts, PositionsInMillimetres) {
    EXPECT_THAT(unitDoubts(circle([](StampedPose& stamped) {
                    stamped.pose.x *= 1000;
                    stamped.pose.y *= 1000;
                })),
                ElementsAre(HasSubstr("in metres")));
}

/// The circle, as told to be driven.
Log told(double positions, double speed) {
    Log log = circle([&](StampedPose& stamped) { stamped.pose.x *= positions, stamped.pose.y *= positions; });
    log.source = "drive.csv";
    log.robots[0].trajectories[0].name = "one";
    log.robots[0].trajectories[0].commands = {{0, {speed, 0.6}}};
    return log;
}

std::string refusal(const Log& log) {
    const auto fits = checkMetres(log);
    return fits ? "" : fits.error().message();
}

TEST(UnitDoubts, PositionsThatCannotBeMetresAreRefusedWithTheUnitTheyLookLike) {
    EXPECT_EQ(refusal(told(1, 0.3)), "");
    EXPECT_EQ(refusal(told(1, 0)), "") << "carried around";
    EXPECT_EQ(refusal(told(1000, 0.3)),
              "drive.csv: robot robot, trajectory one: by its poses it drives at 300 m/s where it is told at most 0.3 "
              "m/s: x and y seem to be in millimetres; expected metres");
    EXPECT_THAT(refusal(told(100, 0.3)), HasSubstr("at 30 m/s where it is told at most 0.3 m/s: x and y seem to be in "
                                                   "centimetres"));
    EXPECT_THAT(refusal(told(1000, 300)), HasSubstr("at 300 m/s where it is told at most 300 m/s: x, y and v_cmd seem "
                                                    "to be in another unit; expected metres"))
        << "no robot is as fast";
    Log folder = told(1000, 0.3);
    folder.files = {{"logs/drive.csv", ""}};
    EXPECT_TRUE(refusal(folder).starts_with("logs/drive.csv: "));
    folder.format = "mrclam";
    EXPECT_EQ(refusal(folder), "") << "the format has its units";
}

TEST(UnitDoubts, PositionsOfTheBallInMillimetres) {
    // Kicked every 10 s, it slows down and lies; its positions have noise of 1 mm.
    const auto kicked = [](double unit) {
        Log log = circle([](StampedPose&) {});
        for (int i = 0; i < 3000; ++i) {
            const double time = std::fmod(0.02 * i, 10.0), rolls = std::min(time, 3.0);
            const double noise = i % 2 == 0 ? 0.001 : -0.001;
            log.robots[0].trajectories[0].ball.push_back(
                {i * 20 * ms, unit * Point{1.5 * rolls - 0.25 * rolls * rolls + noise, 0.3}});
        }
        return log;
    };
    EXPECT_THAT(unitDoubts(kicked(1)), IsEmpty());
    EXPECT_THAT(unitDoubts(kicked(1000)), ElementsAre(HasSubstr("The ball would often move at more than 50 m/s")));
    EXPECT_THAT(withUnitDoubts("fails", kicked(1000)), testing::StartsWith("fails. The ball would"));
    const std::string once = withUnitDoubts("fails.", kicked(1000));
    EXPECT_THAT(once, testing::StartsWith("fails. The ball would"));
    EXPECT_EQ(withUnitDoubts(once, kicked(1000)), once) << "of another log";
}

TEST(UnitDoubts, RangesInMillimetresAndReportedHeadingsInDegrees) {
    const auto reporting = [](double range, double turn) {
        Log log = circle([](StampedPose&) {});
        SensorLog sensor{.sensor = "all"};
        for (int i = 0; i < 600; ++i) {
            sensor.looks.push_back({i * 100 * ms, {{0, range * (i % 9 + 1), 0}}});
            sensor.scans.push_back({i * 100 * ms, 0, 0, {INFINITY}});
            sensor.poses.push_back({i * 100 * ms, {0, 0, turn * i}});
        }
        log.robots[0].trajectories[0].sensors = {sensor};
        return unitDoubts(log);
    };
    EXPECT_THAT(reporting(1, 0.1), IsEmpty());
    EXPECT_THAT(reporting(1000, 0.1), ElementsAre(HasSubstr("not in millimetres")));
    EXPECT_THAT(reporting(1, 3), ElementsAre(HasSubstr("By the poses that they reported")));
}

TEST(UnitDoubts, TrackerThatJumpsNowAndThenIsLeftAlone) {
    int count = 0;
    EXPECT_THAT(unitDoubts(circle([&](StampedPose& stamped) {
                    if (++count % 500 == 0) stamped.pose = {100, 100, 100};
                })),
                IsEmpty());
}

}  // namespace
}  // namespace mrose
