#include "logs/csv_reader.h"

#include <array>
#include <random>

#include <gtest/gtest.h>

#include "logs/csv_writer.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

std::string messageOf(const std::string& text) {
    const auto log = parseCsv(text, "l.csv");
    return log ? "no error" : log.error().message();
}

const Trajectory& only(const Expected<Log>& log) { return log->robots.at(0).trajectories.at(0); }

TEST(CsvReader, ReadsCommandsAndPosesOfOneFile) {
    const auto log = parseCsv(
        "\xEF\xBB\xBF# a comment\r\n"
        "x, y, heading, t, v_cmd, w_cmd\r\n"
        "1, 2, .5, 10.1, 0.3, -0.2\r\n"
        "\r\n"
        "1.5, 2, .5, 10.2, , \r\n"
        ",,, 10.15, 0.4, 0",
        "l.csv");
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_EQ(log->format, "csv");
    EXPECT_EQ(log->robots.at(0).robot, "robot");
    const Trajectory& trajectory = only(log);
    ASSERT_EQ(trajectory.commands.size(), 2u);
    EXPECT_EQ(trajectory.commands[1].time, 10'150'000'000);
    EXPECT_EQ(trajectory.commands[1].command, (Command{0.4, 0}));
    ASSERT_EQ(trajectory.poses.size(), 2u);
    EXPECT_EQ(trajectory.poses[1].time, 10'200'000'000);
    EXPECT_EQ(trajectory.poses[0].pose, (Pose{1, 2, 0.5}));
    EXPECT_EQ(log->robots[0].defects.outOfOrder, 0);
}

TEST(CsvReader, SeparatesRobotsAndTrajectories) {
    const auto log = parseCsv(
        "robot,trajectory,t,v_cmd,w_cmd\n"
        "b,first,0,1,0\nb,second,0,2,0\na,first,5,3,0\nb,first,1,4,0\na,first,6,3,0\n",
        "l.csv");
    ASSERT_TRUE(log) << log.error().message();
    ASSERT_EQ(log->robots.size(), 2u);
    EXPECT_EQ(log->robots[0].robot, "b");
    EXPECT_EQ(log->robots[1].robot, "a");
    ASSERT_EQ(log->robots[0].trajectories.size(), 2u);
    EXPECT_EQ(log->robots[0].trajectories[0].commands.size(), 2u);
    EXPECT_EQ(log->robots[0].trajectories[0].group, 0);
    EXPECT_EQ(log->robots[0].trajectories[1].name, "second");
    EXPECT_EQ(log->robots[0].trajectories[1].group, 1);  // held out on its own
    EXPECT_EQ(log->robots[1].trajectories[0].commands.size(), 2u);
}

TEST(CsvReader, ALogIsSyntheticWhereACommentAboveItsHeaderSaysSo) {
    const auto isSynthetic = [](const std::string& text) { return parseCsv(text, "l.csv").value().synthetic; };
    const std::string rows = "t,v_cmd,w_cmd\n0,1,0\n1,1,0\n";
    EXPECT_TRUE(isSynthetic("# synthetic\n" + rows));
    EXPECT_TRUE(isSynthetic("\xEF\xBB\xBF# made yesterday\n# synthetic: by a simulation\n" + rows));
    EXPECT_FALSE(isSynthetic(rows));
    EXPECT_FALSE(isSynthetic("# not # synthetic\n" + rows));
    EXPECT_FALSE(isSynthetic(rows + "# synthetic\n"));
}

TEST(CsvReader, OneSyntheticFileMakesAFolderSynthetic) {
    const TemporaryFolder folder;
    folder.write("a.csv", "# synthetic\nt,v_cmd,w_cmd\n0,1,0\n1,1,0\n");
    folder.write("b.csv", "t,x,y,heading\n0,1,0,0\n1,1,0,0\n");
    EXPECT_TRUE(readCsv(folder.path()).value().synthetic);
}

TEST(CsvReader, GroupsAreThoseOfTheColumn) {
    const auto log = parseCsv("trajectory,group,t,v_cmd,w_cmd\na,7,0,1,0\nb,7,0,2,0\n", "l.csv");
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_EQ(log->robots[0].trajectories[0].group, 7);
    EXPECT_EQ(log->robots[0].trajectories[1].group, 7);
}

TEST(CsvReader, FilesOfAFolderAreOneLogByTime) {
    const TemporaryFolder folder;
    folder.write("b_commands.csv", "t,v_cmd,w_cmd\n1,0.1,0\n1.1,0.2,0\n");
    folder.write("a_commands.csv", "t,v_cmd,w_cmd\n1.2,0.3,0\n1.3,0.4,0\n");
    folder.write("poses.csv", "t,x,y,heading\n1.05,1,2,3\n1.15,4,5,3\n");
    folder.write("notes.txt", "nothing");
    const auto log = readCsv(folder.path());
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_EQ(log->files.size(), 3u);
    const auto& commands = only(log).commands;
    ASSERT_EQ(commands.size(), 4u);
    const std::array expected = {0.1, 0.2, 0.3, 0.4};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(commands[i].command.v, expected[i]) << i;
    EXPECT_EQ(only(log).poses.size(), 2u);
    EXPECT_EQ(log->robots[0].defects.outOfOrder, 0);
}

/// What is said of a folder of these files, named from a on, each with a minute of commands or poses from a time on.
std::vector<std::string> saidOfFilesFrom(const std::vector<std::string>& starts) {
    const TemporaryFolder folder;
    std::string name = "a.csv";
    for (const std::string& start : starts) {
        const bool commands = name[0] % 2 == 1;
        std::string text = commands ? "t,v_cmd,w_cmd\n" : "t,x,y,heading\n";
        const std::string end = std::to_string(std::stoll(start) + 60);
        for (const std::string& time : {start, end}) text += time + (commands ? ",1,0\n" : ",1,0,0\n");
        folder.write(name, text);
        ++name[0];
    }
    return readCsv(folder.path()).value().incomplete;
}

TEST(CsvReader, AFileWithAnotherClockIsNamedWithItsTimes) {
    using testing::ElementsAre;
    using testing::IsEmpty;
    const std::string asked = " s: is that another clock? Then nothing of both is joined.";
    EXPECT_THAT(saidOfFilesFrom({"0", "1", "1700000000", "60", "61"}),
                ElementsAre("c.csv begins at 1700000000.0 s, the other files' times are 0.0 to 121.0" + asked));
    EXPECT_THAT(saidOfFilesFrom({"7200", "7201", "0", "7201"}),
                ElementsAre("c.csv begins at 0.0 s, the other files' times are 7200.0 to 7261.0" + asked));
    EXPECT_THAT(saidOfFilesFrom({"7200", "9", "0", "7201", "5"}),
                ElementsAre("a.csv and 1 more begin at 7200.0 s, the other files' times are 0.0 to 69.0" + asked));
    EXPECT_THAT(saidOfFilesFrom({"0", "3000"}), IsEmpty()) << "less than an hour";
    EXPECT_THAT(saidOfFilesFrom({"0", "86400", "172800", "259200"}), IsEmpty()) << "a minute of each day";
}

TEST(CsvReader, FilesOfOtherTrajectoriesHaveClocksOfTheirOwn) {
    const TemporaryFolder folder;
    folder.write("a.csv", "trajectory,t,v_cmd,w_cmd\none,0,1,0\none,1,1,0\n");
    folder.write("b.csv", "trajectory,t,v_cmd,w_cmd\ntwo,1700000000,1,0\ntwo,1700000001,1,0\n");
    EXPECT_THAT(readCsv(folder.path()).value().incomplete, testing::IsEmpty());
    folder.write("b.csv", "robot,trajectory,t,v_cmd,w_cmd\nb,one,1700000000,1,0\nb,one,1700000001,1,0\n");
    EXPECT_EQ(readCsv(folder.path()).value().incomplete.size(), 1u) << "robots of a session have one";
}

TEST(CsvReader, CommandsInFilesOfTheirOwnHoldUntilTheirNextValue) {
    const TemporaryFolder folder;
    folder.write("v.csv", "t,v_cmd\n0,0.1\n1,0.2\n2,0.3\n");
    folder.write("w.csv", "t,w_cmd\n0.5,7\n1,8\n3,9\n");
    const auto log = readCsv(folder.path());
    ASSERT_TRUE(log) << log.error().message();
    const auto& commands = only(log).commands;
    ASSERT_EQ(commands.size(), 4u);
    EXPECT_EQ(commands[0].time, 500'000'000);
    EXPECT_EQ(commands[0].command, (Command{0.1, 7}));
    EXPECT_EQ(commands[1].command, (Command{0.2, 8}));
    EXPECT_EQ(commands[2].command, (Command{0.3, 8}));
    EXPECT_EQ(commands[3].command, (Command{0.3, 9}));
    EXPECT_EQ(log->robots[0].defects.unpaired, 1);  // v before w had begun
    EXPECT_EQ(log->robots[0].defects.duplicates, 0);
}

TEST(CsvReader, HeadingsInAFileOfTheirOwnAreInterpolatedAtThePositions) {
    const TemporaryFolder folder;
    folder.write("position.csv", "t,x,y\n0,0,0\n1,1,10\n1.05,2,20\n1.4,3,30\n9,4,40\n");
    folder.write("heading.csv", "t,heading\n1,3.1\n1.1,-3.1\n1.5,-3.0\n");
    const auto log = readCsv(folder.path());
    ASSERT_TRUE(log) << log.error().message();
    const auto& poses = only(log).poses;
    ASSERT_EQ(poses.size(), 2u);
    EXPECT_EQ(poses[0].pose, (Pose{1, 10, 3.1}));
    EXPECT_NEAR(poses[1].pose.heading, 3.14159265358979, 1e-12);  // half way, through pi
    EXPECT_EQ(poses[1].pose.x, 2);
    EXPECT_EQ(log->robots[0].defects.unpaired, 3);  // before, within a pause of 0.4 s, after
}

TEST(CsvReader, DefectsAreCounted) {
    std::string text = "t,v_cmd,w_cmd,x,y,heading\n";
    for (int i = 0; i < 100; ++i) {
        const int shown = i == 20 ? 21 : i == 21 ? 20 : i == 51 ? 50 : i;
        text += std::to_string(shown * 0.02) + (i == 30 ? ",0,0," : ",0.3,0.1,") + std::to_string(0.006 * shown) +
                (i == 70 ? ",5," : ",0,") + std::to_string(i < 80 ? 3.1 : -3.1) + "\n";
    }
    const auto log = parseCsv(text, "l.csv");
    ASSERT_TRUE(log) << log.error().message();
    const LogDefects& found = log->robots[0].defects;
    EXPECT_EQ(found.outOfOrder, 2);  // once among the commands, once among the poses
    EXPECT_EQ(found.duplicates, 2);
    EXPECT_EQ(found.blips, 1);
    ASSERT_EQ(only(log).blips.size(), 1u);
    EXPECT_EQ(only(log).blips[0].time, 600'000'000);
    EXPECT_EQ(found.poseOutliers, 1);
    EXPECT_EQ(found.headingWraps, 1);
    EXPECT_EQ(only(log).commands.size(), 98u);
    EXPECT_EQ(only(log).poses.size(), 98u);
}

TEST(CsvReader, EachErrorIsOneLineWithFileLineAndKey) {
    EXPECT_EQ(messageOf(""), "l.csv: is empty; expected a header line");
    EXPECT_EQ(messageOf("# c\nt,v_cmd,speed\n"),
              "l.csv:2: 'speed': unknown column; known are v_cmd, w_cmd, x, y, heading, t, robot, trajectory, group, "
              "sensor, subject, range, bearing, reported_x, reported_y, reported_heading, scan_start, scan_step, scan, "
              "kick, ball_x, ball_y");
    EXPECT_EQ(messageOf("t,x,x\n1,2,3\n"), "l.csv:1: x: column named twice");
    EXPECT_EQ(messageOf("v_cmd,w_cmd\n1,2\n1,2\n"), "l.csv:1: t: column missing from the header");
    EXPECT_EQ(messageOf("t,v_cmd,w_cmd\n1,2,3\n"), "l.csv: too short: 1 row; expected at least 2");
    EXPECT_EQ(messageOf("t,v_cmd,w_cmd\n1,2,3\n2,fast,3\n"),
              "l.csv:3:3: v_cmd: expected a number within +-1e9, found 'fast'");
    EXPECT_EQ(messageOf("t,v_cmd,w_cmd\n1,2,3\n2,nan,3\n"),
              "l.csv:3:3: v_cmd: expected a number within +-1e9, found 'nan'");
    EXPECT_EQ(messageOf("t,v_cmd,w_cmd\n1,2,3\n9e99,1,3\n"),
              "l.csv:3:1: t: expected seconds within +-4e9, found '9e99'");
    EXPECT_EQ(messageOf("t,v_cmd,w_cmd\n1,2,3\n2,3\n4,5,6\n"), "l.csv:3:4: w_cmd: missing: 2 of 3 columns");
    EXPECT_EQ(messageOf("t,v_cmd,w_cmd\n1,2,3\n2,3,4,5\n"), "l.csv:3:6: more than the 3 columns of the header");
    EXPECT_EQ(messageOf("t,v_cmd,w_cmd\n1,2,3\n,3,4\n"), "l.csv:3: t: the cell is empty");
    EXPECT_EQ(messageOf("robot,t,v_cmd,w_cmd\na,1,2,3\n,2,3,4\n"), "l.csv:3: robot: the cell is empty");
    EXPECT_EQ(messageOf("group,t,v_cmd,w_cmd\n1.5,1,2,3\n1,2,3,4\n"),
              "l.csv:2: group: expected a whole number of at most nine digits");
    EXPECT_EQ(messageOf("robot,t,v_cmd,w_cmd\n\"a,1,2,3\n\"a,2,3,4\n"),
              "l.csv:2: robot: expected a name of at most 64 printable characters without quotes");
    EXPECT_EQ(messageOf("t,v_cmd\n1,2\n2,3\n"),
              "l.csv: robot robot, trajectory whole: neither a command (v_cmd and w_cmd) nor a pose (x, y and heading) "
              "nor the ball (ball_x and ball_y)");
}

TEST(CsvReader, ALastLineThatIsCutOffIsLeftOutAndCounted) {
    const std::string sound = "t,v_cmd,w_cmd\n1,2,3\n2,3,4\n";
    for (const char* cut : {"3", "3,", "3,-", "3,0.", "3,1,-", "3,1,2e"}) {
        const auto log = parseCsv(sound + cut, "l.csv");
        ASSERT_TRUE(log) << log.error().message();
        EXPECT_EQ(only(log).commands.size(), 2u) << cut;
        EXPECT_EQ(log->robots[0].defects.cutLines, 1) << cut;
        EXPECT_EQ(log->incomplete, std::vector<std::string>{"The last line of l.csv is cut off: it is left out."});
    }
    const auto whole = parseCsv(sound + "3,1,4", "l.csv");  // only without a line break
    ASSERT_TRUE(whole) << whole.error().message();
    EXPECT_EQ(only(whole).commands.size(), 3u);
    EXPECT_TRUE(whole->incomplete.empty());
    EXPECT_EQ(messageOf(sound + "3,1,fast"), "l.csv:4:5: w_cmd: expected a number within +-1e9, found 'fast'");
    EXPECT_EQ(messageOf(sound + "3,1,4,5"), "l.csv:4:6: more than the 3 columns of the header");
    EXPECT_EQ(messageOf("t,v_cmd,w_cmd\n1,2,3\n2,3"), "l.csv: too short: 1 row; expected at least 2");
}

TEST(CsvReader, EmptyFileOfAFolderLeavesTheOthers) {
    for (const char* text : {"", "# c\n", "t,x,y,heading\n", "t,x,y,heading\n1,2"}) {
        const TemporaryFolder folder;
        folder.write("a.csv", text);
        folder.write("b.csv", "t,v_cmd,w_cmd\n1,2,3\n2,3,4\n");
        const auto log = readCsv(folder.path());
        ASSERT_TRUE(log) << log.error().message();
        EXPECT_EQ(only(log).commands.size(), 2u);
        EXPECT_EQ(log->incomplete.back(), "a.csv has no rows.");
        folder.write("b.csv", "");
        EXPECT_EQ(readCsv(folder.path()).error().message(),
                  folder.path().string() + ": too short: 0 rows; expected at least 2");
    }
}

TEST(CsvReader, TimeRunningBackwardsForGoodIsAnError) {
    std::string text = "t,v_cmd,w_cmd,x,y,heading\n";
    for (int i = 0; i < 40; ++i)
        text += std::to_string(i < 20 ? 100 + i : i) + ",0.1,0,,,\n" + std::to_string(i) + ",,,1,2,3\n";
    EXPECT_EQ(messageOf(text), "l.csv:42: time runs backwards for good: 99.000 s before line 40");
}

TEST(CsvReader, MissingFilesAndEmptyFoldersAreErrors) {
    const TemporaryFolder folder;
    EXPECT_EQ(readCsv(folder.path()).error().message(), folder.path().string() + ": holds no *.csv");
    EXPECT_NE(readCsv(folder.path() / "no.csv").error().message().find("cannot be read"), std::string::npos);
}

Log randomLog() {
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    Log log;
    for (const char* name : {"pioneer-a", "pioneer-b"}) {
        RobotLog& robot = log.robots.emplace_back(RobotLog{name, {}, {}});
        for (int k = 0; k < 3; ++k) {
            Trajectory& trajectory = robot.trajectories.emplace_back();
            trajectory.name = "run " + std::to_string(k);
            trajectory.group = k / 2;
            Nanoseconds time = -5'000'000'000 + static_cast<Nanoseconds>(random() % 1000);
            double x = 0, y = 0, heading = 0;
            for (int i = 0; i < 200; ++i, time += 1 + static_cast<Nanoseconds>(random() % 100'000'000)) {
                if (i % 3 != 0) trajectory.commands.push_back({time, {normal(random), normal(random) * 1e-9}});
                if (i % 3 == 1) continue;
                x += 0.01 * normal(random);
                y += 0.01 * normal(random);
                heading += 0.05 * normal(random);
                trajectory.poses.push_back({time, {x, y, heading}});
            }
        }
    }
    return log;
}

TEST(CsvWriter, WhatIsWrittenComesBackBitForBit) {
    const Log log = randomLog();
    const TemporaryFolder folder;
    const auto file = folder.path() / "log.csv";
    ASSERT_TRUE(writeCsv(file, log));
    const auto again = readCsv(file);
    ASSERT_TRUE(again) << again.error().message();
    ASSERT_EQ(again->robots.size(), 2u);
    for (std::size_t r = 0; r < 2; ++r) {
        EXPECT_EQ(again->robots[r].robot, log.robots[r].robot);
        ASSERT_EQ(again->robots[r].trajectories.size(), 3u);
        for (std::size_t k = 0; k < 3; ++k) {
            const Trajectory &a = log.robots[r].trajectories[k], &b = again->robots[r].trajectories[k];
            EXPECT_EQ(a.name, b.name);
            EXPECT_EQ(a.group, b.group);
            ASSERT_EQ(a.commands.size(), b.commands.size());
            ASSERT_EQ(a.poses.size(), b.poses.size());
            for (std::size_t i = 0; i < a.commands.size(); ++i) {
                EXPECT_EQ(a.commands[i].time, b.commands[i].time);
                EXPECT_EQ(a.commands[i].command, b.commands[i].command);
            }
            for (std::size_t i = 0; i < a.poses.size(); ++i) {
                EXPECT_EQ(a.poses[i].time, b.poses[i].time);
                EXPECT_EQ(a.poses[i].pose, b.poses[i].pose);
            }
        }
    }
}

TEST(CsvWriter, KeepsThatALogIsSynthetic) {
    Log log = randomLog();
    EXPECT_FALSE(parseCsv(toCsv(log), "l.csv").value().synthetic);
    log.synthetic = true;
    const auto again = parseCsv(toCsv(log), "l.csv");
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_TRUE(again->synthetic);
    EXPECT_EQ(again->robots.size(), log.robots.size());
}

TEST(CsvWriter, WritesTheShortestTextThatIsExact) {
    Log log;
    RobotLog& robot = log.robots.emplace_back(RobotLog{"robot", {}, {}});
    Trajectory& trajectory = robot.trajectories.emplace_back();
    trajectory.name = "whole";
    trajectory.commands = {{0, {0.3, 0}}, {100'000'000, {0.1, -1.5}}};
    trajectory.poses = {{100'000'000, {1, 2, 3}}, {1'248'444'187'156'000'001, {1, 2, 0.1}}};
    EXPECT_EQ(toCsv(log),
              "t,v_cmd,w_cmd,x,y,heading\n"
              "0,0.3,0,,,\n"
              "0.1,0.1,-1.5,1,2,3\n"
              "1248444187.156000001,,,1,2,0.1\n");
}

TEST(CsvWriter, AnUnwritablePlaceIsAnError) { EXPECT_FALSE(writeCsv("/nowhere/at/all/log.csv", randomLog())); }

}  // namespace
}  // namespace mrose
