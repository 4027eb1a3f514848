#include "identification/sensor_inspection.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/pose.h"
#include "identification/planted_sensors.h"
#include "logs/mrclam_reader.h"
#include "support/test_data.h"
#include "support/units.h"

namespace mrose {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::size_t cameraAt = 0, slamAt = 1;

std::vector<SensorInspection> inspected(const Log& log) { return inspectSensors(log, log.robots.at(0)); }
SensorInspection camera(const PlantedSensors& plant) { return inspected(plantedSensorLog(plant)).at(cameraAt); }

/// 1 from 120 to 150 s, 0 elsewhere, times a factor.
std::function<double(double)> stretch(double factor) {
    return [factor](double t) { return t >= 120 && t < 150 ? factor : 0; };
}

TEST(SensorLateness, IsFoundForReadingsAndForReportedPoses) {
    for (const double lateness : {-0.12, 0.0, 0.04, 0.35, 1.2}) {
        const auto sensors = inspected(plantedSensorLog({.lateness = lateness}));
        for (const std::size_t index : {cameraAt, slamAt}) {
            const SensorLateness& found = sensors.at(index).lateness;
            ASSERT_TRUE(found.identified) << found.reason;
            EXPECT_NEAR(found.lateness, lateness, 4 * found.error) << index;
            EXPECT_GT(found.error, 1e-5);
            EXPECT_LT(found.error, 0.005);
        }
    }
}

TEST(SensorLateness, StandardErrorIsThatOfManyLogs) {
    double squares = 0;
    constexpr int logs = 24;
    for (int i = 0; i < logs; ++i) {
        const auto found = camera({.seconds = 150, .seed = static_cast<std::uint64_t>(100 + i)}).lateness;
        ASSERT_TRUE(found.identified);
        squares += std::pow((found.lateness - 0.04) / found.error, 2);
    }
    // A mean of 24 squares of normal numbers is within 0.4 and 2 but once in a thousand times.
    EXPECT_GT(squares / logs, 0.4);
    EXPECT_LT(squares / logs, 2);
}

TEST(SensorLateness, IsThatOfTheTurningAlsoWhereAQuarterOfTheReadingsIsWrong) {
    Log log = plantedSensorLog({.lateness = 0.2});
    int count = 0;
    for (Look& look : log.robots[0].trajectories[0].sensors[0].looks)
        for (LogReading& reading : look.readings)
            if (++count % 4 == 0) reading.bearing = 0.7 * std::sin(count);
    const SensorInspection found = inspected(log).at(cameraAt);
    ASSERT_TRUE(found.lateness.identified);
    EXPECT_NEAR(found.lateness.lateness, 0.2, 5 * found.lateness.error);
    // Of the wrong ones, those within 0.15 rad are none.
    EXPECT_GT(found.grossShare(), 0.18);
    EXPECT_LT(found.grossShare(), 0.25);
}

TEST(SensorLateness, WhatCannotBeKnownIsSaidWithItsReason) {
    const auto reason = [](const Log& log, std::size_t sensor = cameraAt) {
        const SensorLateness found = inspected(log).at(sensor).lateness;
        EXPECT_FALSE(found.identified);
        return found.reason;
    };
    EXPECT_THAT(reason(plantedSensorLog({.turns = false})), HasSubstr("hardly turns"));
    Log log = plantedSensorLog({.seconds = 8});
    EXPECT_THAT(reason(log), HasSubstr("too little"));
    log = plantedSensorLog({});
    for (LogSubject& subject : log.subjects) subject.position.reset();
    EXPECT_THAT(reason(log), HasSubstr("too little"));
    log = plantedSensorLog({});
    log.robots[0].trajectories[0].poses.clear();
    EXPECT_EQ(reason(log), "no ground truth");
    EXPECT_EQ(reason(log, slamAt), "no ground truth");
    log = plantedSensorLog({});
    for (Look& look : log.robots[0].trajectories[0].sensors[0].looks)
        for (LogReading& reading : look.readings) reading = {reading.subject, std::abs(reading.bearing), reading.range};
    EXPECT_EQ(reason(log), "its readings do not fit the ground truth");
}

TEST(SensorInspection, PosesOfAnotherClockDoNotFollowTheMotion) {
    const auto slam = [](const Log& log) { return inspected(log).at(slamAt); };
    for (const double shift : {-35.0, 20.0}) {
        Log log = plantedSensorLog({});
        for (StampedPose& pose : log.robots[0].trajectories[0].sensors[1].poses) pose.time += fromSeconds(shift);
        const SensorInspection found = slam(log);
        ASSERT_TRUE(found.followed) << shift;
        EXPECT_LT(*found.followed, 0.5);
        EXPECT_EQ(found.lateness.reason, "its readings do not fit the ground truth");
    }
    // neither noise nor gross errors nor standing is another clock
    EXPECT_FALSE(slam(plantedSensorLog({.lateness = 0.5})).followed);
    EXPECT_FALSE(slam(plantedSensorLog({.bearingNoise = 0.5, .rangeNoise = 10})).followed);
    EXPECT_FALSE(slam(plantedSensorLog({.drives = 0})).followed);
    Log log = plantedSensorLog({});
    int count = 0;
    for (StampedPose& pose : log.robots[0].trajectories[0].sensors[1].poses)
        if (++count % 10 == 0) pose.pose.x += 40, pose.pose.heading += 2;
    EXPECT_FALSE(slam(log).followed);
}

TEST(SensorInspection, PosesWithExchangedCoordinatesAreKnownByWhereTheyLie) {
    const auto slam = [](const Log& log) { return inspected(log).at(slamAt).pose; };
    for (const double lateness : {0.04, 0.9}) {
        Log log = plantedSensorLog({.lateness = lateness});
        EXPECT_FALSE(slam(log).looksExchanged()) << "a frame of its own";
        std::vector<StampedPose>& poses = log.robots[0].trajectories[0].sensors[1].poses;
        for (StampedPose& pose : poses) pose.pose = relative(Pose{7, -3, 2}, pose.pose);
        const PoseMisfit fits = slam(log);
        EXPECT_FALSE(fits.looksExchanged());
        EXPECT_EQ(fits.poses, poses.size());
        EXPECT_NEAR(fits.distance, 0.2 * 0.02 * std::sqrt(2 * std::log(2.0)), 0.001) << "of two normal errors";
        // the drift of its heading
        EXPECT_NEAR(fits.heading, 1e-4 * 140, 0.002);
        for (StampedPose& pose : poses) std::swap(pose.pose.x, pose.pose.y);
        const PoseMisfit exchanged = slam(log);
        EXPECT_TRUE(exchanged.looksExchanged());
        EXPECT_GT(exchanged.distance, 1);
        EXPECT_EQ(inspected(log).at(slamAt).lateness.reason, "its readings do not fit the ground truth");
    }
}

TEST(SensorInspection, CountsWhatWasReportedAndHowOften) {
    Log log = plantedSensorLog({.period = 0.25, .seconds = 100});
    SensorLog& sensor = log.robots[0].trajectories[0].sensors[0];
    sensor.looks[3].readings.clear();
    sensor.defects.joinedStamps = 7;
    log.subjects[5].kind = LogSubject::Kind::robot;
    std::size_t readings = 0, ofRobot = 0, empty = 0;
    for (const Look& look : sensor.looks) {
        readings += look.readings.size();
        empty += look.readings.empty();
        for (const LogReading& reading : look.readings) ofRobot += reading.subject == 5;
    }
    const SensorInspection found = inspected(log).at(cameraAt);
    EXPECT_EQ(found.sensor, "camera");
    EXPECT_EQ(found.looks, 393u);
    EXPECT_EQ(found.looks - found.seeingLooks, empty);
    EXPECT_EQ(found.readings, readings);
    EXPECT_EQ(found.readings - found.landmarkReadings, ofRobot);
    EXPECT_EQ(found.subjects, 8u);
    EXPECT_NEAR(found.period, 0.25, 1e-6);
    EXPECT_NEAR(found.periodSpread, 0, 1e-6);
    EXPECT_EQ(found.defects.joinedStamps, 7);
    EXPECT_EQ(inspected(log).at(slamAt).poses, 393u);
    EXPECT_NEAR(found.bearingSpread, 0.005, 0.0007);
    EXPECT_NEAR(found.rangeSpread, 0.02, 0.002);
}

TEST(SensorInspection, RobotsThatAreReportedAreWhereTheirTruthIs) {
    Log log = plantedSensorLog({.lateness = 0.1});
    // Robot b stands where landmark 2 does, which is then said of no landmark.
    const Point place = *log.subjects[2].position;
    log.subjects[2] = {.name = "2", .kind = LogSubject::Kind::robot, .robot = "b"};
    const std::size_t without = inspected(log).at(cameraAt).known;
    Trajectory standing{.name = "whole"};
    for (const StampedPose& pose : log.robots[0].trajectories[0].poses)
        standing.poses.push_back({pose.time, {place.x, place.y, 1}});
    log.robots.push_back({"b", {standing}, {}});
    const SensorInspection found = inspected(log).at(cameraAt);
    EXPECT_EQ(found.known, found.readings);
    EXPECT_LT(without, found.readings);
    EXPECT_EQ(found.gross, 0u);
}

TEST(SensorChanges, OfASensorIsFoundAndDistinguishedFromOneOfTheTruth) {
    const auto ofSensor = camera({.bearingOffset = stretch(0.05)});
    ASSERT_THAT(ofSensor.changes, SizeIs(1));
    const auto ofTruth = camera({.headingOffset = stretch(0.05)});
    ASSERT_THAT(ofTruth.changes, SizeIs(1));
    for (const SensorChange& change : {ofSensor.changes[0], ofTruth.changes[0]}) {
        EXPECT_TRUE(change.bearing);
        EXPECT_NEAR(change.begin, 120, 0.7);
        EXPECT_NEAR(change.end, 150, 0.7);
        // The stretch is a tenth of all: it takes the median with it by 0.15 spreads of 5 mrad.
        EXPECT_NEAR(change.offset, 0.05 - 0.0008, 4 * change.error);
        EXPECT_LT(change.error, 0.005);
    }
    EXPECT_EQ(ofSensor.changes[0].cause, SensorChange::Cause::sensor);
    EXPECT_NEAR(ofSensor.changes[0].headingOffset, 0, 0.002);
    EXPECT_EQ(ofTruth.changes[0].cause, SensorChange::Cause::truth);
    EXPECT_NEAR(ofTruth.changes[0].headingOffset, 0.05, 0.002);
}

TEST(SensorChanges, OfARobotThatStandsNobodyKnowsTheCause) {
    const auto found = camera({.drives = 110, .bearingOffset = stretch(-0.05)});
    ASSERT_THAT(found.changes, SizeIs(1));
    EXPECT_NEAR(found.changes[0].offset, -0.05, 0.003);
    EXPECT_EQ(found.changes[0].cause, SensorChange::Cause::unknown);
}

TEST(SensorChanges, OfRangesAreSharesOfThem) {
    const auto found = camera({.rangeFactor = [](double t) { return t >= 120 && t < 150 ? 1.2 : 1; }});
    ASSERT_THAT(found.changes, SizeIs(1));
    EXPECT_FALSE(found.changes[0].bearing);
    EXPECT_NEAR(found.changes[0].begin, 120, 0.7);
    EXPECT_NEAR(found.changes[0].end, 150, 0.7);
    EXPECT_NEAR(found.changes[0].offset, 0.2, 0.01);
}

TEST(SensorChanges, AreNotFoundWhereNothingFits) {
    Log log = plantedSensorLog({.bearingOffset = stretch(0.05)});
    int count = 0;
    for (Look& look : log.robots[0].trajectories[0].sensors[0].looks)
        for (LogReading& reading : look.readings)
            if (++count % 3 != 0) reading.range += 2;
    EXPECT_THAT(inspected(log).at(cameraAt).changes, IsEmpty());
}

TEST(SensorChanges, AreNotFoundWhereAllIsAsEver) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
        EXPECT_THAT(camera({.bearingNoise = 0.02, .bearingOffset = [](double) { return 0.03; }, .seed = seed}).changes,
                    IsEmpty());
}

Expected<Log> mrclam(int dataset) {
    const auto data = realData();
    const auto folder = data ? *data / "mrclam" / ("MRCLAM_Dataset" + std::to_string(dataset)) : "";
    if (!data || !std::filesystem::exists(folder)) return fail(folder.string(), "is not there");
    return readMrclam(folder);
}

TEST(RealSensors, CamerasOfMrclamLookEvery236MillisecondsAndAreALittleLate) {
    for (const int dataset : {6, 7}) {
        const auto log = mrclam(dataset);
        if (!log) GTEST_SKIP() << "no real logs: set MROSE_DATA";
        for (const RobotLog& robot : log->robots) {
            const auto sensors = inspectSensors(*log, robot);
            ASSERT_THAT(sensors, SizeIs(1));
            EXPECT_NEAR(sensors[0].period, 0.236, 0.004);
            ASSERT_TRUE(sensors[0].lateness.identified) << sensors[0].lateness.reason;
            // The robots are of one kind: their cameras agree within their errors.
            EXPECT_NEAR(sensors[0].lateness.lateness, 0.04, 3 * sensors[0].lateness.error + 0.002);
            EXPECT_LT(sensors[0].lateness.error, 0.015);
            EXPECT_LT(sensors[0].grossShare(), 0.005);
        }
    }
}

TEST(RealSensors, WhatIsOffOnRobotOneOfDataSetSevenInTheTenthMinuteIsItsTrackedHeading) {
    const auto log = mrclam(7);
    if (!log) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    const auto found = inspectSensors(*log, log->robots.at(0)).at(0);
    const auto change = std::find_if(found.changes.begin(), found.changes.end(),
                                     [](const SensorChange& c) { return c.bearing && std::abs(c.begin - 587) < 2; });
    ASSERT_NE(change, found.changes.end());
    EXPECT_NEAR(change->end - change->begin, 26, 3);
    EXPECT_NEAR(change->offset, -0.05, 0.01);
    EXPECT_EQ(change->cause, SensorChange::Cause::truth);
    EXPECT_NEAR(change->headingOffset, change->offset, 3 * change->headingError);
}

TEST(RealSensors, RobotsTwoToFiveOfDataSetSixAreTrackedAndSeeTheSameThroughout) {
    const auto log = mrclam(6);
    if (!log) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    for (std::size_t robot = 1; robot < log->robots.size(); ++robot)
        EXPECT_THAT(inspectSensors(*log, log->robots[robot]).at(0).changes, IsEmpty()) << log->robots[robot].robot;
}

}  // namespace
}  // namespace mrose
