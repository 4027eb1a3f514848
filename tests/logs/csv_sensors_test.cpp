#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "logs/csv_reader.h"
#include "logs/csv_writer.h"
#include "support/temporary_folder.h"
#include "support/units.h"

namespace mrose {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Two commands, 10 s apart: what sensors report in between is of their time.
const std::string driven = "t,v_cmd,w_cmd\n0,0.3,0\n10,0.3,0\n";

/// A folder's log of `driven` and the rows of one sensor file.
class CsvSensorsTest : public testing::Test {
protected:
    Expected<Log> read(const std::string& rows) {
        folder.write("commands.csv", driven);
        folder.write("sensors.csv", rows);
        return readCsv(folder.path());
    }
    const SensorLog& sensor(const Expected<Log>& log, std::size_t index = 0) {
        return log->robots.at(0).trajectories.at(0).sensors.at(index);
    }
    /// What is said of wrong rows, without the folder.
    std::string messageOf(const std::string& rows) {
        const auto log = read(rows);
        if (log) return "no error";
        const std::string message = log.error().message(), place = folder.path().string() + '/';
        return message.starts_with(place) ? message.substr(place.size()) : message;
    }

    TemporaryFolder folder;
};

TEST_F(CsvSensorsTest, RowsOfOneInstantAreALookAndOneWithoutASubjectSawNothing) {
    const auto log = read(
        "t,sensor,subject,range,bearing\n"
        "1,camera,6,1.5,-0.2\n1,camera,7,2.5,0.2\n1.2,camera,,,\n1.4,camera,7,2.4,0.1\n1.4,bumper,wall,0,0\n");
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_THAT(sensor(log).looks, ElementsAre(Look{1000 * ms, {{0, 1.5, -0.2}, {1, 2.5, 0.2}}}, Look{1200 * ms, {}},
                                               Look{1400 * ms, {{1, 2.4, 0.1}}}));
    EXPECT_EQ(sensor(log).sensor, "camera");
    EXPECT_EQ(sensor(log, 1).sensor, "bumper");
    EXPECT_THAT(sensor(log, 1).looks, ElementsAre(Look{1400 * ms, {{2, 0, 0}}}));
    EXPECT_EQ(log->subjects.at(2).name, "wall");
}

TEST_F(CsvSensorsTest, StampsWithinTheLookSpanAreOneLookAndAllThatIsMendedIsCounted) {
    const std::string rows =
        "t,sensor,subject,range,bearing\n"
        "1.001,camera,7,2.5,0.2\n1,camera,6,1.5,-0.2\n1.005,camera,6,1.6,-0.2\n1.006,camera,6,1.7,0\n";
    const auto log = read(rows);
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_THAT(sensor(log).looks,
                ElementsAre(Look{1000 * ms, {{1, 1.6, -0.2}, {0, 2.5, 0.2}}}, Look{1006 * ms, {{1, 1.7, 0}}}));
    EXPECT_EQ(sensor(log).defects.joinedStamps, 2);
    EXPECT_EQ(sensor(log).defects.repeated, 1);
    EXPECT_EQ(sensor(log).defects.outOfOrder, 1);
    LogOptions apart;
    apart.lookSpan = 0;
    EXPECT_EQ(sensor(readCsv(folder.path(), apart)).looks.size(), 4u);
}

TEST_F(CsvSensorsTest, SubjectsAreLandmarksWithAPositionRobotsByNameOrOthersOfWhichTheLogSaysSo) {
    folder.write("landmarks.csv", "subject,x,y\n6,0.5,-4.25\n8,1,2\n");
    const auto log = read("t,sensor,subject,range,bearing\n1,camera,9,1,0\n1,camera,robot,1,0\n1,camera,6,2,0\n");
    ASSERT_TRUE(log) << log.error().message();
    ASSERT_EQ(log->subjects.size(), 4u);  // 8 was never reported
    EXPECT_EQ(log->subjects[0].name, "6");
    EXPECT_EQ(log->subjects[0].position, (Point{0.5, -4.25}));
    EXPECT_EQ(log->subjects[2].name, "9");
    EXPECT_EQ(log->subjects[2].kind, LogSubject::Kind::landmark);
    EXPECT_FALSE(log->subjects[2].position);
    EXPECT_EQ(log->subjects[3].kind, LogSubject::Kind::robot);
    EXPECT_EQ(log->subjects[3].robot, "robot");
    EXPECT_THAT(log->incomplete, ElementsAre("Nothing says where subject 9 stands."));
    EXPECT_EQ(log->files.size(), 1u);
    EXPECT_EQ(log->measurementFiles.size(), 2u) << "landmarks and readings";
}

TEST(CsvSensors, OneFileSaysInRowsWithoutATimeWhereLandmarksAreAndWhoIsARobot) {
    const auto log = parseCsv(
        "robot,t,x,y,heading,sensor,subject,range,bearing\n"
        ",,0.5,-4.25,,,6,,\n"
        "b,,,,,,marker 5,,\n"
        "a,0,1,2,0,,,,\n"
        "a,1,1,2,0,camera,marker 5,1,0\n",
        "l.csv");
    ASSERT_TRUE(log) << log.error().message();
    ASSERT_EQ(log->robots.size(), 1u);
    EXPECT_EQ(log->robots[0].trajectories[0].poses.size(), 2u);
    ASSERT_EQ(log->subjects.size(), 2u);
    EXPECT_EQ(log->subjects[0].position, (Point{0.5, -4.25}));
    EXPECT_EQ(log->subjects[1].kind, LogSubject::Kind::robot);
    EXPECT_EQ(log->subjects[1].robot, "b");
    EXPECT_THAT(log->incomplete, IsEmpty());
}

TEST_F(CsvSensorsTest, ReportedPosesAreSortedAndUnwrapped) {
    const auto log = read(
        "t,sensor,reported_x,reported_y,reported_heading\n1,slam,1,2,3.1\n3,slam,1,2,-3.1\n2,slam,1.5,2,3.1\n"
        "3,slam,1,3,-3.1\n");
    ASSERT_TRUE(log) << log.error().message();
    const auto& poses = sensor(log).poses;
    ASSERT_EQ(poses.size(), 3u);
    EXPECT_EQ(poses[1], (StampedPose{2000 * ms, {1.5, 2, 3.1}}));
    EXPECT_EQ(poses[2].pose.y, 3);
    EXPECT_DOUBLE_EQ(poses[2].pose.heading, 2 * std::numbers::pi - 3.1);
    EXPECT_EQ(sensor(log).defects.headingWraps, 1);
    EXPECT_EQ(sensor(log).defects.repeated, 1);
    EXPECT_EQ(sensor(log).defects.outOfOrder, 1);
    EXPECT_THAT(sensor(log).looks, IsEmpty());
}

TEST_F(CsvSensorsTest, RangesOfAScanAreSeparatedBySemicolonsOrBlanks) {
    const auto log = read(
        "t,sensor,scan_start,scan_step,scan\n"
        "1,laser,-1.5,0.5,1; inf;;2.5\n2,laser,1.5,-0.5,1  2.5 inf\n3,laser,0,0,4\n4,laser,0,1,;\n");
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_THAT(sensor(log).scans,
                ElementsAre(LogScan{1000 * ms, -1.5, 0.5, {1, INFINITY, INFINITY, 2.5}},
                            LogScan{2000 * ms, 1.5, -0.5, {1, 2.5, INFINITY}}, LogScan{3000 * ms, 0, 0, {4}},
                            LogScan{4000 * ms, 0, 1, {INFINITY, INFINITY}}));
}

TEST_F(CsvSensorsTest, EachWrongRowIsSaidByFileLineAndColumn) {
    const auto reading = [&](const std::string& row) {
        return messageOf("t,sensor,subject,range,bearing\n1,camera,6,1,0\n" + row + "\n");
    };
    EXPECT_EQ(reading("2,camera,6,-0.2,1.5"),
              "sensors.csv:3: range: expected a range of at least 0 m, found -0.2: are columns swapped?");
    EXPECT_EQ(reading("2,camera,6,1,14.5"),
              "sensors.csv:3: bearing: expected radians within +-2 pi, found 14.5: are these degrees?");
    EXPECT_EQ(reading("2,camera,6,nan,0"), "sensors.csv:3:12: range: expected a number within +-1e9, found 'nan'");
    EXPECT_EQ(reading("2,camera,6,1,"), "sensors.csv:3: bearing: the cell is empty");
    EXPECT_EQ(reading("2,camera,,1,0"), "sensors.csv:3: subject: the cell is empty");
    EXPECT_EQ(reading("2,,6,1,0"), "sensors.csv:3: sensor: the cell is empty");
    EXPECT_EQ(reading(",camera,6,1,0"), "sensors.csv:3: t: the cell is empty");
    EXPECT_EQ(reading("2,camera,\"6\",1,0"),
              "sensors.csv:3: subject: expected a name of at most 64 printable characters without quotes");
    EXPECT_EQ(messageOf("t,subject,range,bearing\n1,6,1,0\n"), "sensors.csv:1: sensor: column missing from the header");
    EXPECT_EQ(messageOf("t,sensor,reported_x,reported_y\n1,slam,6,1\n"),
              "sensors.csv:2: reported_heading: the cell is empty");
    EXPECT_EQ(messageOf("sensor,subject,range,bearing\ncamera,6,1,0\n"),
              "sensors.csv:1: t: column missing from the header");
}

TEST_F(CsvSensorsTest, EachWrongScanIsSaidByFileLineAndColumn) {
    const auto scan = [&](const std::string& cells) {
        return messageOf("t,sensor,scan_start,scan_step,scan\n1,laser," + cells + "\n");
    };
    EXPECT_EQ(scan("0,0.1,1;nan;2"),
              "sensors.csv:2: scan: expected ranges separated by semicolons, inf or nothing without an echo, found "
              "'nan'");
    EXPECT_EQ(scan("0,0.1,1;-2"),
              "sensors.csv:2: scan: expected a range of at least 0 m, found -2.0: are columns swapped?");
    EXPECT_EQ(scan("0,1,1;2;3;4;5;6;7;8"),
              "sensors.csv:2: scan_step: expected 8 rays within a whole turn of 2 pi, found 7.0 rad: are these "
              "degrees?");
    EXPECT_EQ(scan("-90,1,1;2"),
              "sensors.csv:2: scan_start: expected radians within +-2 pi, found -90.0: are these degrees?");
    EXPECT_EQ(scan("0,,1;2"), "sensors.csv:2: scan_step: the cell is empty");
}

TEST_F(CsvSensorsTest, WrongSubjectsAreSaidByFileLineAndColumn) {
    const auto subjects = [&](const std::string& rows) { return messageOf(rows); };
    EXPECT_EQ(subjects("subject,x,y\n6,1,2\n6,1,3\n"), "sensors.csv:3: subject: 6 is declared twice, differently");
    EXPECT_EQ(subjects("subject,x,y\n6,1,2\n6,1,2\n"), subjects("subject,x,y\n6,1,2\n"))
        << "as each file of a folder may say";
    EXPECT_EQ(subjects("subject,x,y\n6,1,\n"), "sensors.csv:2: y: the cell is empty");
    EXPECT_EQ(subjects("subject,x,y\n,1,2\n"), "sensors.csv:2: subject: the cell is empty");
    EXPECT_EQ(subjects("subject,robot,x,y\n6,b,1,2\n"),
              "sensors.csv:2: robot: a subject with a position is a landmark, no robot");
}

TEST_F(CsvSensorsTest, AClockOfAnotherLogAndOneThatIsSetBackAreErrors) {
    EXPECT_EQ(messageOf("t,sensor,subject,range,bearing\n# c\n20,camera,6,1,0\n21,camera,6,1,0\n"),
              "sensors.csv:3: t: sensor camera: readings from 20.000 to 21.000 s; expected some within the robot's "
              "commands and poses, 0.000 to 10.000 s");
    std::string rows = "t,sensor,subject,range,bearing\n";
    for (int i = 0; i < 40; ++i) rows += std::to_string(0.1 * (i % 20) + (i < 20 ? 5 : 0)) + ",camera,6,1,0\n";
    EXPECT_EQ(messageOf(rows), "sensors.csv:22: time runs backwards for good: 6.900 s before line 21");
}

/// A log of two robots with a camera, a laser and a localisation each; landmarks and a robot that is not in the log.
Log randomSensors() {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    const auto pause = [&] { return 6 * ms + static_cast<Nanoseconds>(random() % 100'000'000); };
    Log log;
    log.subjects = {{"m1", LogSubject::Kind::robot, "b"},
                    {"6", LogSubject::Kind::landmark, {}, Point{normal(random), normal(random)}},
                    {"c", LogSubject::Kind::robot, "c"},
                    {"door", LogSubject::Kind::landmark}};
    for (const char* name : {"a", "b"}) {
        Trajectory trajectory{.name = "whole"};
        trajectory.commands = {{0, {1, 0}}, {5000 * ms, {1, 0}}};
        SensorLog camera{.sensor = "camera"}, slam{.sensor = "slam"}, laser{.sensor = "laser"};
        Nanoseconds time = 0;
        double heading = 0;
        for (int i = 0; i < 60; ++i) {
            Look& look = camera.looks.emplace_back(Look{time += pause(), {}});
            for (std::size_t subject = 0; subject < log.subjects.size(); ++subject)
                if (random() % 3 == 0)
                    look.readings.push_back({subject, std::abs(normal(random)), std::sin(normal(random))});
            slam.poses.push_back({time, {normal(random), normal(random), heading += 0.5 * normal(random)}});
            LogScan& scan = laser.scans.emplace_back(LogScan{time, normal(random), 0.1 * normal(random), {}});
            for (int ray = 0; ray < 5; ++ray)
                scan.ranges.push_back(random() % 4 == 0 ? INFINITY : std::abs(normal(random)));
        }
        trajectory.sensors = {camera, slam, laser};
        log.robots.push_back({name, {trajectory}, {}});
    }
    return log;
}

TEST(CsvSensors, WhatIsWrittenComesBackBitForBit) {
    const Log log = randomSensors();
    const auto again = parseCsv(toCsv(log), "l.csv");
    ASSERT_TRUE(again) << again.error().message();
    ASSERT_EQ(again->subjects.size(), log.subjects.size());
    for (std::size_t i = 0; i < log.subjects.size(); ++i) {
        EXPECT_EQ(again->subjects[i].name, log.subjects[i].name);
        EXPECT_EQ(again->subjects[i].kind, log.subjects[i].kind);
        EXPECT_EQ(again->subjects[i].robot, log.subjects[i].robot);
        EXPECT_EQ(again->subjects[i].position, log.subjects[i].position);
    }
    ASSERT_EQ(again->robots.size(), 2u);
    for (std::size_t r = 0; r < 2; ++r) {
        const auto &written = log.robots[r].trajectories[0].sensors, &read = again->robots[r].trajectories[0].sensors;
        ASSERT_EQ(read.size(), written.size());
        for (std::size_t i = 0; i < read.size(); ++i) {
            EXPECT_EQ(read[i].sensor, written[i].sensor);
            EXPECT_EQ(read[i].looks, written[i].looks);
            EXPECT_EQ(read[i].poses, written[i].poses);
            EXPECT_EQ(read[i].scans, written[i].scans);
        }
    }
    EXPECT_TRUE(toCsv(*again) == toCsv(log));
}

}  // namespace
}  // namespace mrose
