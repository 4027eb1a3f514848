#include "logs/husky_reader.h"

#include <cmath>
#include <cstdio>
#include <set>

#include <gtest/gtest.h>

#include "logs/pose_grid.h"
#include "support/test_data.h"

namespace mrose {
namespace {

constexpr const char* header =
    "window,calib_step,t_s,cmd_left_radps,cmd_right_radps,wheel_left_radps,wheel_right_radps,icp_x_m,icp_y_m,"
    "icp_yaw_rad,imu_yaw_rad,steady\n";

/// Rows of a window, 40 of 50 ms unless told: command `left`, `right`; the wheels run at `wheels`.
std::string window(int number, int step, bool steady, double left, double right, double wheels, int rows = 40) {
    std::string text;
    char row[200];
    for (int i = 0; i < rows; ++i) {
        std::snprintf(row, sizeof row, "%d,%d,%.5f,%g,%g,%g,%g,%g,%g,%g,%g,%d\n", number, step, 0.05 * i, left, right,
                      wheels, wheels, 0.02 * i, 0.0, 0.0, 0.25, steady ? 1 : 0);
        text += row;
    }
    return text;
}

TEST(HuskyReader, EachWindowIsATrajectoryOfItsGroup) {
    const auto log = parseHusky(
        header + window(0, 4, false, 1, 2, 0) + window(1, 4, true, 1, 2, 1.5) + window(2, 6, false, 3, 3, 0), "h.csv");
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_EQ(log->format, "husky-windows");
    ASSERT_EQ(log->robots.size(), 1u);
    const auto& windows = log->robots[0].trajectories;
    ASSERT_EQ(windows.size(), 3u);
    EXPECT_EQ(windows[0].group, 4);
    EXPECT_EQ(windows[1].group, 4);
    EXPECT_EQ(windows[2].group, 6);
    EXPECT_FALSE(windows[0].steady);
    EXPECT_TRUE(windows[1].steady);
    EXPECT_EQ(windows[1].poses.size(), 40u);
    EXPECT_EQ(windows[1].poses.front().pose, (Pose{0, 0, 0}));
}

TEST(HuskyReader, WheelCommandsGoThroughTheDrive) {
    LogOptions options;
    options.drive = {0.2, 0.5};
    const auto log = parseHusky(header + window(0, 0, true, 2, 3, 1), "h.csv", options);
    ASSERT_TRUE(log) << log.error().message();
    const Trajectory& trajectory = log->robots[0].trajectories[0];
    EXPECT_DOUBLE_EQ(trajectory.commands[0].command.v, 0.5);
    EXPECT_DOUBLE_EQ(trajectory.commands[0].command.w, 0.4);
    EXPECT_DOUBLE_EQ(trajectory.measuredVelocity[0].velocity.v, 0.2);
    const auto wheels = options.drive.toWheels(trajectory.commands[0].command);
    EXPECT_NEAR(wheels.left, 2, 1e-12);
    EXPECT_NEAR(wheels.right, 3, 1e-12);
}

TEST(HuskyReader, AWindowKnowsThePastOfThoseThatItContinues) {
    const auto log = parseHusky(header + window(0, 0, false, 1, 1, 1) + window(1, 0, true, 2, 2, 3) +
                                    window(2, 1, false, 3, 3, 3) + window(3, 1, true, 4, 4, 3),
                                "h.csv");
    ASSERT_TRUE(log) << log.error().message();
    const auto& windows = log->robots[0].trajectories;
    EXPECT_EQ(windows[0].commands.size(), 40u);
    EXPECT_EQ(windows[1].commands.size(), 80u);
    EXPECT_EQ(windows[2].commands.size(), 120u);
    EXPECT_EQ(windows[3].commands.size(), 120u);  // 4 s of past
    EXPECT_EQ(windows[3].poses.size(), 40u);
    const Nanoseconds start = windows[3].poses.front().time;
    for (std::size_t i = 0; i < 120; ++i) {
        EXPECT_EQ(windows[3].commands[i].time, start + (static_cast<Nanoseconds>(i) - 80) * 50'000'000);
        EXPECT_NEAR(windows[3].commands[i].command.v, 0.165 * (2 + static_cast<double>(i / 40)), 1e-12) << i;
    }
}

TEST(HuskyReader, ThePastReachesFourSecondsBackAlsoIntoAWindow) {
    std::string text = header;
    for (int i = 0; i < 4; ++i) text += window(i, 0, i > 0, 1, 1, 1, 30);
    const auto log = parseHusky(text, "h.csv");
    ASSERT_TRUE(log) << log.error().message();
    const Trajectory& last = log->robots[0].trajectories.at(3);
    EXPECT_EQ(last.commands.size(), 80u + 30u);
    EXPECT_EQ(last.poses.front().time - last.commands.front().time, 4'000'000'000);
}

TEST(HuskyReader, AStopBetweenStepsEndsThePast) {
    const auto log = parseHusky(header + window(0, 0, true, 1, 1, 1) + window(1, 1, false, 2, 2, 0) +
                                    window(2, 2, false, 2, 2, 4) + window(4, 2, true, 2, 2, 4),
                                "h.csv");
    ASSERT_TRUE(log) << log.error().message();
    for (const Trajectory& trajectory : log->robots[0].trajectories)
        EXPECT_EQ(trajectory.commands.size(), 40u) << trajectory.name;
}

TEST(HuskyReader, AFirstWindowLabelledWithTheStepBeforeJoinsTheStepOfItsCommand) {
    std::string first = window(1, 6, false, 2, 3, 1);
    first.replace(0, first.find('\n'), "1,6,0,1,1,1,1,0,0,0,0,0");  // the command before still stands in its first row
    const auto log = parseHusky(header + window(0, 6, true, 1, 1, 1) + first + window(2, 7, true, 2, 3, 1), "h.csv");
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_EQ(log->robots[0].trajectories.at(0).group, 6);
    EXPECT_EQ(log->robots[0].trajectories.at(1).group, 7);
}

TEST(HuskyReader, AStartHasTheVelocityThatTheRobotMeasured) {
    const auto log = parseHusky(header + window(0, 0, true, 1, 1, 1) + window(1, 0, true, 1, 1, 2), "h.csv");
    ASSERT_TRUE(log) << log.error().message();
    const Trajectory& second = log->robots[0].trajectories[1];
    const MeasuredStart start = measuredStart(second, second.poses.front().time);
    ASSERT_TRUE(start.valid);
    EXPECT_EQ(start.pose, (Pose{0, 0, 0}));
    EXPECT_NEAR(start.velocity.velocity.v, 0.165 * (3 * 1 + 1 * 2) / 4,
                1e-12);  // the last 0.2 s: three samples before, one now
    EXPECT_NEAR(start.velocity.velocity.w, 0.25, 1e-12);
}

TEST(HuskyReader, EachErrorIsOneLineWithFileAndLine) {
    const auto messageOf = [](const std::string& text) {
        const auto log = parseHusky(text, "h.csv");
        return log ? "no error" : log.error().message();
    };
    EXPECT_EQ(messageOf("window,calib_step\n1,2\n"), "h.csv:1: is no header of Husky windows");
    EXPECT_EQ(messageOf(header), "h.csv: too short: 0 rows; expected at least 2");
    EXPECT_EQ(messageOf(header + window(0, 0, true, 1, 1, 1) + "1,0,0,1,1,1,1,0,0,0,0,1\n"),
              "h.csv:42: window 1: too short: 1 row; expected at least 2");
    EXPECT_EQ(messageOf(std::string(header) + "0,0,0,1,1,1,1,,0,0,0,1\n"), "h.csv:2: icp_x_m: the cell is empty");
    EXPECT_EQ(messageOf(std::string(header) + "0,0,0,1,1,1,1,0,0,0,nan,1\n"),
              "h.csv:2:21: imu_yaw_rad: expected a number within +-1e9, found 'nan'");
    std::string backwards;
    for (int i = 20; i > 0; --i) backwards += "0,0," + std::to_string(i) + ",1,1,1,1,0,0,0,0,1\n";
    EXPECT_EQ(messageOf(header + backwards), "h.csv:3: time runs backwards for good: 1.000 s before line 2");
    EXPECT_EQ(messageOf(std::string(header) + "0,0,0,1,1,1,1,0,0,0,0,1\n0,0,2000,1,1,1,1,0,0,0,0,1\n"),
              "h.csv:2: window 0: longer than 1000 s");
}

TEST(HuskyReader, ALastLineThatIsCutOffIsLeftOutWithAWindowThatItLeavesTooShort) {
    const std::string first = header + window(0, 0, true, 1, 1, 1), row = "1,0,0,1,1,1,1,0,0,0,0,1\n";
    const auto whole = parseHusky(first, "h.csv");
    ASSERT_TRUE(whole) << whole.error().message();
    for (const std::string& end : {std::string("1,0,0,1,1"), row + "1,0,0.05,1"}) {
        const auto log = parseHusky(first + end, "h.csv");
        ASSERT_TRUE(log) << log.error().message();
        ASSERT_EQ(log->robots[0].trajectories.size(), 1u);
        EXPECT_EQ(log->robots[0].trajectories[0].poses.size(), whole->robots[0].trajectories[0].poses.size());
        EXPECT_EQ(log->robots[0].defects.cutLines, 1);
        EXPECT_EQ(log->incomplete.front(), "The last line of h.csv is cut off: it is left out.");
        EXPECT_EQ(log->incomplete.size(), end.starts_with(row) ? 2u : 1u);
    }
}

class RealHusky : public ::testing::Test {
protected:
    void SetUp() override {
        const auto data = realData();
        if (!data || !std::filesystem::exists(*data / "drive" / "husky_windows.csv"))
            GTEST_SKIP() << "no Husky windows: set MROSE_DATA";
        auto log = readHusky(*data / "drive" / "husky_windows.csv");
        ASSERT_TRUE(log) << log.error().message();
        windows_ = std::move(log->robots.at(0).trajectories);
    }
    std::vector<Trajectory> windows_;
};

TEST_F(RealHusky, Has603WindowsIn201GroupsOfWhichTwoThirdsAreSteady) {
    EXPECT_EQ(windows_.size(), 603u);
    std::multiset<int> groups;
    std::size_t steady = 0;
    for (const Trajectory& item : windows_) {
        groups.insert(item.group);
        steady += item.steady;
        EXPECT_EQ(item.poses.size(), 40u);
    }
    EXPECT_EQ(steady, 402u);
    EXPECT_EQ(std::set<int>(groups.begin(), groups.end()).size(), 201u);
    for (const int group : groups) EXPECT_EQ(groups.count(group), 3u) << group;
}

/// What tells the meaning of the columns: the gyro's rate integrates to the change of the tracked heading.
TEST_F(RealHusky, GyroIntegratesToTheTrackedHeading) {
    double products = 0, squares = 0;
    for (const Trajectory& item : windows_) {
        const Nanoseconds start = item.poses.front().time;
        double turned = 0;
        for (const StampedVelocity& sample : item.measuredRotation)
            if (sample.time >= start) turned += 0.05 * sample.velocity.w;
        products += turned * (item.poses.back().pose.heading - item.poses.front().pose.heading);
        squares += turned * turned;
    }
    EXPECT_NEAR(products / squares, 1, 0.05);
}

TEST_F(RealHusky, WheelsGoOnWhereWindowsContinue) {
    std::size_t continued = 0;
    for (const Trajectory& item : windows_) {
        const Nanoseconds start = item.poses.front().time;
        for (std::size_t i = 1; i < item.measuredVelocity.size(); ++i) {
            if (item.measuredVelocity[i].time != start) continue;
            ++continued;
            EXPECT_EQ(start - item.measuredVelocity[i - 1].time, 50'000'000);
            EXPECT_LE(std::abs(item.measuredVelocity[i].velocity.v - item.measuredVelocity[i - 1].velocity.v), 0.25);
        }
        EXPECT_TRUE(!item.steady || item.commands.front().time < start) << item.name;
    }
    EXPECT_GT(continued, 580u);
}

}  // namespace
}  // namespace mrose
