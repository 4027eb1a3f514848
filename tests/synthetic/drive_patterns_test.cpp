#include "synthetic/drive_patterns.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "synthetic/log_generator.h"

namespace mrose {
namespace {

/// Where ideal kinematics are at each command, and one period after the last.
std::vector<Pose> idealPath(const std::vector<StampedCommand>& commands) {
    std::vector<Pose> path{{}};
    for (std::size_t i = 0; i < commands.size(); ++i) {
        const double held = i + 1 < commands.size() ? toSeconds(commands[i + 1].time - commands[i].time) : 0.1;
        path.push_back(path.back() * exp(Twist{held * commands[i].command.v, 0, held * commands[i].command.w}));
    }
    return path;
}

std::vector<StampedPose> driven(DrivePattern pattern) {
    const double duration = patternDuration(pattern);
    return runReferenceRobot(patternCommands(pattern, duration, 1, 0), duration, {}, 1).truth;
}

TEST(DrivePatterns, TheEllipseClosesAndHasItsAxes) {
    const auto path = idealPath(patternCommands(DrivePattern::ellipse, -1, 3, 0));
    EXPECT_NEAR(path.back().x, 0, 0.01);
    EXPECT_NEAR(path.back().y, 0, 0.01);
    EXPECT_NEAR(path.back().heading, 2 * M_PI, 0.005);
    const auto [left, right] =
        std::minmax_element(path.begin(), path.end(), [](const Pose& a, const Pose& b) { return a.x < b.x; });
    const auto [low, high] =
        std::minmax_element(path.begin(), path.end(), [](const Pose& a, const Pose& b) { return a.y < b.y; });
    const PatternShape shape;
    EXPECT_NEAR(left->x, -shape.ellipseLong, 0.01);
    EXPECT_NEAR(right->x, shape.ellipseLong, 0.01);
    EXPECT_NEAR(low->y, 0, 0.01);
    EXPECT_NEAR(high->y, 2 * shape.ellipseShort, 0.01);
    for (const Pose& p : path) {
        const double onEllipse = std::hypot(p.x / shape.ellipseLong, (p.y - shape.ellipseShort) / shape.ellipseShort);
        EXPECT_NEAR(onEllipse, 1, 0.01);
    }
}

TEST(DrivePatterns, TheJinkPassesTheObstacleAndComesBackToItsLine) {
    const auto path = idealPath(patternCommands(DrivePattern::jink, -1, 3, 0));
    const PatternShape shape;
    EXPECT_NEAR(path.back().y, 0, 0.01);
    EXPECT_NEAR(path.back().heading, 0, 0.005);
    double side = 0, back = 0;
    for (const Pose& p : path) {
        side = std::max(side, p.y);
        back = std::min(back, p.y);
        if (p.x < shape.jinkStraight - 0.05) {
            EXPECT_NEAR(p.y, 0, 0.005);
        }
    }
    EXPECT_NEAR(side, shape.jinkSide, 0.005);
    EXPECT_GT(back, -0.005);
    EXPECT_GT(path.back().x, 2 * shape.jinkStraight + shape.jinkLength);
}

TEST(DrivePatterns, TheReferenceRobotDrivesThemRoughly) {
    const auto ellipse = driven(DrivePattern::ellipse);
    EXPECT_NEAR(ellipse.back().pose.heading, 2 * M_PI, 1.0);
    EXPECT_LT(std::hypot(ellipse.back().pose.x, ellipse.back().pose.y), 0.8);
    const auto jink = driven(DrivePattern::jink);
    EXPECT_NEAR(jink.back().pose.heading, 0, 0.2);
    EXPECT_NEAR(jink.back().pose.y, 0, 0.4);
    for (const auto& run : {ellipse, jink})  // it has come to rest before the end
        EXPECT_EQ(run.back().pose, run[run.size() - 10].pose);
}

TEST(DrivePatterns, CommandsComeTenTimesASecondWithinTheRobotsLimits) {
    for (const DrivePattern pattern :
         {DrivePattern::random, DrivePattern::hardSwitch, DrivePattern::jink, DrivePattern::ellipse}) {
        const auto commands = patternCommands(pattern, 30, 5, 2);
        ASSERT_GE(commands.size(), 298u);
        for (std::size_t i = 0; i < commands.size(); ++i) {
            EXPECT_LE(std::abs(commands[i].command.v), 0.4);
            EXPECT_LE(std::abs(commands[i].command.w), 1.7454);
            EXPECT_EQ(commands[i].time % ReferenceRobot::step, 0);
            if (i > 0) {
                EXPECT_NEAR(toSeconds(commands[i].time - commands[i - 1].time), 0.1, 0.0141);
            }
        }
    }
}

TEST(DrivePatterns, CommandsDependOnSeedAndIndex) {
    const auto same = [](const auto& a, const auto& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const StampedCommand& x, const StampedCommand& y) {
            return x.time == y.time && x.command == y.command;
        });
    };
    const auto commands = patternCommands(DrivePattern::random, 20, 1, 0);
    EXPECT_TRUE(same(commands, patternCommands(DrivePattern::random, 20, 1, 0)));
    EXPECT_FALSE(same(commands, patternCommands(DrivePattern::random, 20, 2, 0)));
    EXPECT_FALSE(same(commands, patternCommands(DrivePattern::random, 20, 1, 1)));
}

TEST(DrivePatterns, RandomDrivingHasEveryKindOfManoeuvre) {
    int straight = 0, standing = 0, onTheSpot = 0, reversals = 0, switches = 0, ramps = 0, count = 0;
    for (std::uint32_t index = 0; index < 40; ++index) {
        const auto commands = patternCommands(DrivePattern::random, 60, 1, index);
        for (std::size_t i = 2; i < commands.size(); ++i, ++count) {
            const Command a = commands[i - 2].command, b = commands[i - 1].command, c = commands[i].command;
            straight += c.w == 0 && c.v != 0;
            standing += c.w == 0 && c.v == 0;
            onTheSpot += c.v == 0 && c.w != 0;
            reversals += b.v * c.v < -0.01;
            switches += std::abs(b.v) >= 0.28 && c.v == 0;
            ramps += (b.v - a.v) * (c.v - b.v) > 0;
        }
    }
    for (const int kind : {straight, standing, ramps}) EXPECT_GT(kind, count / 25);
    EXPECT_GT(onTheSpot, count / 100);
    for (const int kind : {reversals, switches}) EXPECT_GT(kind, 40);
}

TEST(DrivePatterns, AHardSwitchGoesFromFullSpeedToZeroInOneCommand) {
    for (std::uint32_t index = 0; index < 50; ++index) {
        const auto commands = patternCommands(DrivePattern::hardSwitch, 15, 1, index);
        int found = 0;
        for (std::size_t i = 25; i + 5 < commands.size(); ++i) {
            const bool full = std::all_of(commands.begin() + static_cast<std::ptrdiff_t>(i) - 23,
                                          commands.begin() + static_cast<std::ptrdiff_t>(i),
                                          [](const StampedCommand& c) { return std::abs(c.command.v) == 0.4; });
            const bool stands = std::all_of(commands.begin() + static_cast<std::ptrdiff_t>(i),
                                            commands.begin() + static_cast<std::ptrdiff_t>(i) + 5,
                                            [](const StampedCommand& c) { return c.command == Command{}; });
            if (full && stands && commands[i].time > fromSeconds(7.3) && commands[i].time < fromSeconds(11.2)) ++found;
        }
        EXPECT_GE(found, 1) << index;
    }
}

}  // namespace
}  // namespace mrose
