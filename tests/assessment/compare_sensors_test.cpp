#include <cmath>

#include <gtest/gtest.h>

#include "assessment/compare.h"
#include "assessment/played_scenarios.h"
#include "assessment/test_models.h"
#include "geometry/elementary.h"
#include "logs/looks.h"
#include "logs/pose_grid.h"
#include "perception/logged_view.h"
#include "report/comparison_files.h"
#include "sensing/body_sight.h"
#include "sensing/odometry.h"
#include "sensing/sensor_view.h"
#include "support/scenes.h"

namespace mrose {
namespace {

constexpr Nanoseconds lookPeriod = second / 5, latency = second / 10;

/// Reports landmarks, exactly.
class LandmarkSensor final : public Sensor {
public:
    std::string name() const override { return "camera"; }
    std::vector<ReadingKind> gives() const override { return {{"camera.landmarks", &recordType<SeenBody>()}}; }
    Nanoseconds period() const override { return lookPeriod; }
    void sense(const SensorView& view, std::span<std::byte>, Observation& out) const override {
        std::vector<SeenBody> seen;
        const Placement own(view.poseBefore(view.robot, 0));
        const auto landmarks = landmarksOf(view.scene.environment);
        for (std::uint32_t i = 0; i < landmarks.size(); ++i)
            seen.push_back({i, own.rotateBack(landmarks[i].position - own.origin), view.timeBefore(0)});
        if (view.wants(0)) out.add("camera.landmarks", view.timeBefore(0), std::span<const SeenBody>(seen));
    }
};

/// Adds the looks of a camera that is late, reports all others all round, and each every `everyth` time only, with an
/// offset of the range.
void addLooks(Log& log, int everyth, double offset) {
    LoggedView view(log);
    for (std::size_t r = 0; r < log.robots.size(); ++r) {
        SensorLog sensor;
        sensor.sensor = "camera";
        Trajectory& trajectory = log.robots[r].trajectories.front();
        for (Nanoseconds time = trajectory.poses.front().time + second; time < trajectory.poses.back().time - second;
             time += lookPeriod) {
            Look look{time, {}};
            const bool reports = (time / lookPeriod) % everyth == 0;
            for (const LoggedSubject& subject : view.at(r, 0, time - latency, {100, 6.3}))
                if (reports)
                    look.readings.push_back({subject.subject, subject.state.range + offset, subject.state.bearing});
            sensor.looks.push_back(std::move(look));
        }
        trajectory.sensors = {sensor};
    }
}

/// Two robots in circles beside each other, and a landmark.
Log twoRobots(int everyth = 1, double offset = 0) {
    Log log;
    log.source = "made-up";
    log.format = "csv";
    for (const std::string name : {"a", "b"}) {
        Trajectory t = obedientTrajectory(0, 130 * second, [](double) { return Command{0.1, 0.1}; });
        for (StampedPose& pose : t.poses) pose.pose.y += name == "a" ? 0 : 3;
        log.robots.push_back({name, {std::move(t)}, {}});
        log.subjects.push_back({"robot " + name, LogSubject::Kind::robot, name, {}});
    }
    log.subjects.push_back({"post", LogSubject::Kind::landmark, "", Point{2, 1}});
    addLooks(log, everyth, offset);
    return log;
}

SensorPointer idealCamera(double fieldOfView = 2 * std::numbers::pi) {
    BodySight sight;
    sight.latency = latency;
    sight.fieldOfView = fieldOfView;
    return std::make_shared<const BodySensor>(sight, sight, 1.0, SensorTraits{"camera", lookPeriod});
}

ScenarioParts partsOf(const Log& log, std::vector<SensorPointer> sensors) {
    ScenarioParts parts = playersOf(log, std::make_shared<const HeldCommandModel>());
    parts.scene.robotTypes[0].sensors = std::move(sensors);
    return parts;
}

Comparison compared(const Log& log, ScenarioParts parts, bool readings = true) {
    const auto world = LogWorld::create(std::move(parts), std::make_shared<const Log>(log));
    EXPECT_TRUE(world) << world.error().message();
    const auto requests = rolloutsOf(*world, {second, std::nullopt, 10 * second});
    ComparisonOptions options;
    options.readings = readings;
    const auto comparison = compare(*world, *requests, options);
    EXPECT_TRUE(comparison) << comparison.error().message();
    return *comparison;
}

TEST(CompareSensors, ExactSensorsOfRobotsThatObeyAreAlike) {
    const Log log = twoRobots();
    const Comparison comparison = compared(log, partsOf(log, {idealCamera()}));
    ASSERT_EQ(comparison.sensors.size(), 1u);
    const ComparedSensor& sensor = comparison.sensors[0];
    EXPECT_EQ(sensor.name, "camera");
    ASSERT_TRUE(sensor.robots[0] && sensor.robots[1]);
    const StreamFigures& all = sensor.all;
    // Of 10 s those looks count that are measured in it and reported a control period before its end.
    const std::size_t perRollout = 49;
    EXPECT_NEAR(static_cast<double>(all.looks.real), static_cast<double>(2 * 12 * perRollout), 24.0);
    EXPECT_NEAR(static_cast<double>(all.looks.simulated), static_cast<double>(all.looks.real), 24.0);
    EXPECT_EQ(all.reported.real.of, all.looks.real) << "the other robot alone: nothing says where posts are";
    for (const BlockShare& share : {all.reported.real, all.reported.simulated}) EXPECT_EQ(share.share, 1);
    for (const BlockShare& share : {all.empty.real, all.empty.simulated}) EXPECT_EQ(share.share, 0);
    for (const ReadingErrors& errors : {all.range.of.real, all.range.of.simulated}) {
        EXPECT_NEAR(errors.distribution.mean, 0, 1e-9);
        EXPECT_LT(errors.deviation, 1e-9);
    }
    EXPECT_LT(all.bearing.of.real.deviation, 1e-9);
    EXPECT_LT(all.bearing.of.simulated.deviation, 1e-9);
    for (const SensedLook& look : sensor.looks.simulated) {
        ASSERT_EQ(look.subjects.size(), 1u);
        EXPECT_EQ(look.subjects[0].subject, 1 - look.robot);
        EXPECT_NEAR(look.subjects[0].range, 3, 0.01);
        EXPECT_GE(look.time, 0);
    }
    EXPECT_EQ(all.reportedTest.p, 1);
}

TEST(CompareSensors, FilesOfReadingsAreAmongThoseThatWereCompared) {
    Log log = twoRobots();
    log.files = {{"driven.csv", "1"}};
    log.measurementFiles = {{"seen.csv", "2"}};
    const auto names = [&](bool readings) {
        std::string all;
        for (const LogFile& file : compared(log, partsOf(log, {idealCamera()}), readings).log.files)
            all += file.path + ' ';
        return all;
    };
    EXPECT_EQ(names(true), "driven.csv seen.csv ");
    EXPECT_EQ(names(false), "driven.csv ");
}

TEST(CompareSensors, WhatTheRealSensorDoesOtherwiseIsFound) {
    const Log log = twoRobots(2, 0.1);
    const StreamFigures all = compared(log, partsOf(log, {idealCamera()})).sensors[0].all;
    EXPECT_NEAR(all.reported.real.share, 0.5, 0.02);
    EXPECT_NEAR(all.empty.real.share, 0.5, 0.02);
    EXPECT_EQ(all.reported.simulated.share, 1);
    EXPECT_NEAR(all.range.of.real.distribution.mean, 0.1, 1e-6);
    EXPECT_LE(all.reportedTest.p, 0.005);
    EXPECT_LE(all.range.test.p, 0.005);
    EXPECT_NEAR(all.range.test.statistic, 1, 1e-9);
}

TEST(CompareSensors, LandmarksAreFoundByTheirNames) {
    const Log log = twoRobots();
    ScenarioParts parts = partsOf(log, {std::make_shared<const LandmarkSensor>()});
    const auto post = [](const std::string& name, const Point& place) {
        ShapePart part;
        part.centre = place;
        part.radius = 0.05;
        Obstacle obstacle;
        obstacle.name = obstacle.landmark = name;
        obstacle.shape = Shape::fromParts(name, {part});
        return obstacle;
    };
    parts.scene.environment.obstacles = {post("unknown", {-3, -3}), post("post", {2, 1})};
    const ComparedSensor sensor = compared(log, std::move(parts)).sensors.at(0);
    ASSERT_GT(sensor.all.reported.simulated.of, 100u);
    EXPECT_EQ(sensor.all.reported.simulated.of, sensor.all.looks.simulated);
    EXPECT_EQ(sensor.all.reported.real.of, sensor.all.looks.real) << "robots are not what the simulated one reports";
    EXPECT_EQ(sensor.all.reported.simulated.share, 1);
    EXPECT_LT(std::abs(sensor.all.range.of.simulated.distribution.mean), 1e-9);
    for (const SensedLook& look : sensor.looks.simulated)
        for (const SensedSubject& subject : look.subjects) EXPECT_EQ(subject.subject, 2u);
}

TEST(CompareSensors, NothingOfTheMotionDependsOnThem) {
    const Log log = twoRobots();
    const Comparison with = compared(log, partsOf(log, {idealCamera()})), without = compared(log, partsOf(log, {}));
    EXPECT_EQ(errorsCsv(with), errorsCsv(without));
    EXPECT_TRUE(without.sensors.empty());
    EXPECT_EQ(comparisonJson(without, {}).find("sensors"), std::string::npos);
    EXPECT_TRUE(compared(log, partsOf(log, {idealCamera()}), false).sensors.empty()) << "not asked for";
}

TEST(CompareSensors, SensorsWithoutACounterpartAreNotCompared) {
    Log log = twoRobots();
    const SensorPointer odometry = std::make_shared<const Odometry>(0, 0, SensorTraits{"camera", 0});
    EXPECT_TRUE(compared(log, partsOf(log, {odometry})).sensors.empty()) << "of another kind";
    log.robots[0].trajectories[0].sensors.clear();
    const Comparison one = compared(log, partsOf(log, {idealCamera()}));
    ASSERT_EQ(one.sensors.size(), 1u);
    EXPECT_FALSE(one.sensors[0].robots[0]);
    EXPECT_TRUE(one.sensors[0].robots[1]);
    for (const SensedLook& look : one.sensors[0].looks.simulated) EXPECT_EQ(look.robot, 1u);
    log.robots[1].trajectories[0].sensors[0].looks.clear();
    EXPECT_TRUE(compared(log, partsOf(log, {idealCamera()})).sensors.empty()) << "it never looked";
}

TEST(CompareSensors, SimulatedLooksCountWhereTheRealSensorLooked) {
    Log log = twoRobots();
    for (RobotLog& robot : log.robots)
        std::erase_if(robot.trajectories[0].sensors[0].looks,
                      [](const Look& look) { return look.time > 40 * second && look.time < 90 * second; });
    const ComparedSensor sensor = compared(log, partsOf(log, {idealCamera()})).sensors.at(0);
    for (const SensedLook& look : sensor.looks.simulated) {
        // the session begins with the log, the first rollout after a second
        const double time = 1 + 10.0 * static_cast<double>(look.request) + toSeconds(look.time);
        EXPECT_TRUE(time < 40.2 || time > 89.6) << time;
    }
}

TEST(CompareSensors, EmptyLooksCountAsALogOfWhatWasSeenHasThem) {
    Log log = twoRobots();
    const auto mostEmpty = [&] {
        // The other robot is in view for a part of each turn, and pauses are longer than a rollout.
        const ComparedSensor sensor = compared(log, partsOf(log, {idealCamera(2)})).sensors.at(0);
        EXPECT_GT(sensor.all.reported.simulated.of, 100u);
        std::size_t most = 0, now = 0;
        const SensedLook* last = nullptr;
        for (const SensedLook& look : sensor.looks.simulated) {
            const bool same = last != nullptr && last->request == look.request && last->robot == look.robot;
            now = !look.empty() ? 0 : same ? now + 1 : 1;
            most = std::max(most, now);
            last = &look;
        }
        return most;
    };
    EXPECT_GT(mostEmpty(), 40u);
    for (RobotLog& robot : log.robots) robot.trajectories[0].sensors[0].defects.emptyLooks = 1;
    EXPECT_LE(mostEmpty(), static_cast<std::size_t>(mostEmptyLooks));
}

TEST(CompareSensors, RolloutsHaveDrawsOfTheirOwn) {
    const Log log = twoRobots();
    BodySight sight;
    sight.bearingNoise = 0.02;
    sight.latency = latency;
    const SensorPointer noisy =
        std::make_shared<const BodySensor>(sight, sight, 1.0, SensorTraits{"camera", lookPeriod});
    const ComparedSensor sensor = compared(log, partsOf(log, {noisy})).sensors.at(0);
    std::vector<double> first, second;
    for (const SensedLook& look : sensor.looks.simulated)
        if (look.robot == 0 && look.request < 2)
            (look.request == 0 ? first : second).push_back(look.subjects.at(0).bearingError);
    ASSERT_GT(first.size(), 40u);
    int same = 0;
    for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i)
        same += std::abs(first[i] - second[i]) < 1e-6;
    EXPECT_LT(same, 3);
    EXPECT_NEAR(sensor.all.bearing.of.simulated.deviation, 0.02, 0.002);
}

TEST(CompareSensors, ReadingsAreWrittenAsCsv) {
    const Log log = twoRobots(2);
    const Comparison comparison = compared(log, partsOf(log, {idealCamera(2)}));
    const std::string csv = readingsCsv(comparison);
    std::size_t rows = 0;
    for (const LookStreams& looks : {comparison.sensors[0].looks})
        for (const auto* stream : {&looks.real, &looks.simulated})
            for (const SensedLook& look : *stream) rows += std::max<std::size_t>(1, look.subjects.size());
    EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), 1 + rows);
    const auto cells = [](std::string_view line) { return std::count(line.begin(), line.end(), ','); };
    const auto header = cells(csv.substr(0, csv.find('\n')));
    for (std::size_t at = 0; at < csv.size(); at = csv.find('\n', at) + 1)
        ASSERT_EQ(cells(std::string_view(csv).substr(at, csv.find('\n', at) - at)), header);
    EXPECT_NE(csv.find(",robot b,1,"), std::string::npos);
    EXPECT_NE(csv.find(",real,"), std::string::npos);
    EXPECT_NE(comparisonJson(comparison, {}).find("reported_by_bearing"), std::string::npos);
}

}  // namespace
}  // namespace mrose
