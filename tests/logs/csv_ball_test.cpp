#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "logs/csv_reader.h"
#include "logs/csv_writer.h"
#include "support/units.h"

namespace mrose {
namespace {

Expected<Log> ballLog(const std::string& rows) { return parseCsv(rows, "log.csv"); }

std::string ballRefusal(const std::string& rows) {
    const auto log = ballLog(rows);
    return log ? "no error" : log.error().message();
}

TEST(CsvBall, KicksAndBallStandBesideCommandsAndPosesOrAlone) {
    const auto log = ballLog(
        "t,v_cmd,w_cmd,x,y,heading,kick,ball_x,ball_y\n"
        "0,0.1,0,1,2,0.5,,3,4\n0.1,,,,,,0.75,,\n0.2,,,1.1,2,0.5,,3.5,4.5\n0.3,0,0,,,,1,3.6,4.6\n");
    ASSERT_TRUE(log) << log.error().message();
    const Trajectory& trajectory = log->robots.at(0).trajectories.at(0);
    EXPECT_EQ(trajectory.commands.size(), 2u);
    EXPECT_EQ(trajectory.poses.size(), 2u);
    ASSERT_EQ(trajectory.kicks.size(), 2u);
    EXPECT_EQ(trajectory.kicks[0].time, 100 * ms);
    EXPECT_EQ(trajectory.kicks[0].power, 0.75);
    ASSERT_EQ(trajectory.ball.size(), 3u);
    EXPECT_EQ(trajectory.ball[1].time, 200 * ms);
    EXPECT_EQ(trajectory.ball[1].place, (Point{3.5, 4.5}));
}

TEST(CsvBall, ABallAloneIsALog) {
    const auto log = ballLog("t,ball_x,ball_y\n0,1,2\n0.1,1,2.1\n");
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_EQ(log->robots.at(0).trajectories.at(0).ball.size(), 2u);
    EXPECT_EQ(ballRefusal("t,kick\n0,1\n1,1\n"),
              "log.csv: robot robot, trajectory whole: neither a command (v_cmd and w_cmd) nor a pose (x, y and "
              "heading) nor the ball (ball_x and ball_y)");
}

TEST(CsvBall, HalfABallAndKicksWithoutMeaningAreRefused) {
    EXPECT_EQ(ballRefusal("t,ball_x,ball_y\n0,1,2\n0.1,1,\n"), "log.csv:3: ball_y: the cell is empty");
    EXPECT_EQ(ballRefusal("t,v_cmd,w_cmd,ball_x\n0,1,2,\n0.1,1,1,4\n"), "log.csv:3: ball_y: the cell is empty");
    for (const char* power : {"1.5", "-0.1"})
        EXPECT_THAT(ballRefusal("t,v_cmd,w_cmd,kick\n0,1,2,\n0.1,,," + std::string(power) + "\n"),
                    testing::HasSubstr("log.csv:3: kick: expected the power of a kick, 0 to 1, found "));
}

TEST(CsvBall, IsConditionedAndCounted) {
    const auto log = ballLog(
        "t,ball_x,ball_y,kick\n0,1,1,\n0.02,1.01,1,\n0.02,1.02,1,0.5\n0.06,1.06,1,\n0.04,9,1,\n0.08,1.08,1,0.5\n"
        "0.08,,,0.6\n0.6,1.1,1,\n");
    ASSERT_TRUE(log) << log.error().message();
    const RobotLog& robot = log->robots.at(0);
    const Trajectory& trajectory = robot.trajectories.at(0);
    ASSERT_EQ(trajectory.ball.size(), 5u);
    EXPECT_EQ(trajectory.ball[1].place.x, 1.02) << "the last of equal stamps";
    EXPECT_EQ(trajectory.ball[2].place.x, 1.06) << "sorted, and the outlier of 0.04 s dropped";
    ASSERT_EQ(trajectory.kicks.size(), 2u);
    EXPECT_EQ(trajectory.kicks[1].power, 0.6);
    EXPECT_EQ(robot.defects.ballOutliers, 1);
    EXPECT_EQ(robot.defects.duplicates, 2);
    EXPECT_EQ(robot.defects.outOfOrder, 1);
    EXPECT_EQ(robot.defects.ballGaps, 1);
    EXPECT_NEAR(robot.defects.longestBallGap, 0.52, 1e-9);
}

TEST(CsvBall, IsWrittenAndReadBackToTheBit) {
    Log log;
    log.robots.push_back({"a", {}, {}});
    Trajectory& trajectory = log.robots[0].trajectories.emplace_back();
    trajectory.name = "one";
    trajectory.commands = {{0, {0.1, 0.2}}, {100 * ms, {0.3, -1.0 / 3}}};
    trajectory.poses = {{50 * ms, {1.0 / 3, 2, 0.1}}};
    trajectory.kicks = {{60 * ms, 1.0 / 7}};
    trajectory.ball = {{0, {1.0 / 9, 2}}, {16 * ms, {0.1, 0.2}}};
    const auto again = ballLog(toCsv(log));
    ASSERT_TRUE(again) << again.error().message();
    const Trajectory& read = again->robots.at(0).trajectories.at(0);
    ASSERT_EQ(read.kicks.size(), 1u);
    EXPECT_EQ(read.kicks[0].power, 1.0 / 7);
    ASSERT_EQ(read.ball.size(), 2u);
    EXPECT_EQ(read.ball[0].place, trajectory.ball[0].place);
    EXPECT_EQ(read.ball[1].time, 16 * ms);
    EXPECT_EQ(read.commands.size(), 2u);
    EXPECT_EQ(read.poses, trajectory.poses);
}

}  // namespace
}  // namespace mrose
