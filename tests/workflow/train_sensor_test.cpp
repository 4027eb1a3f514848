#include "workflow/train_sensor.h"

#include <cmath>

#include <gtest/gtest.h>

#include "identification/planted_sensors.h"
#include "logs/csv_writer.h"
#include "support/temporary_folder.h"
#include "workflow/expect_error.h"
#include "workflow/generate_logs.h"
#include "workflow/predict_readings.h"

namespace mrose {
namespace {

Log withoutTruth() {
    Log log = plantedSensorLog({});
    Trajectory& trajectory = log.robots[0].trajectories[0];
    for (const StampedPose& pose : trajectory.poses) trajectory.commands.push_back({pose.time, {0.1, 0.1}});
    trajectory.poses.clear();
    return log;
}

class TrainSensor : public testing::Test {
protected:
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    std::string write(const std::string& name, const Log& log) const {
        EXPECT_TRUE(writeCsv(path(name), log));
        return path(name);
    }
    TrainSensorRequest request(const std::string& log, const std::string& sensor) const {
        TrainSensorRequest request{.logs = {log}, .sensor = sensor, .output = path("learned.net")};
        request.training.components = 1;
        request.training.reported.folds = request.training.error.folds = 2;
        request.training.reported.epochs = request.training.error.epochs = 20;
        return request;
    }
    const TemporaryFolder folder_;
};

TEST_F(TrainSensor, LearnsWhatTheLogsSensorReports) {
    GenerateRequest driving{.folder = path("logs"), .pattern = "random", .duration = 60, .trajectories = 8};
    driving.sensors = true;
    ASSERT_TRUE(generateLogs(driving));
    const auto pose = trainSensor(request(path("logs"), "localisation"));
    ASSERT_TRUE(pose) << pose.error().message();
    EXPECT_EQ(pose->network.measures, SensorNetwork::Measures::pose);
    EXPECT_TRUE(pose->network.learned.synthetic);
    EXPECT_NEAR(toSeconds(pose->network.period), 0.1, 0.002);
    EXPECT_NEAR(toSeconds(pose->network.latency), 0.1, 0.02);
    EXPECT_TRUE(pose->notices.empty());
    const auto loaded = loadSensor(path("learned.net"));
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ(*loaded, pose->network);
    expectError(predictReadings({path("learned.net"), path("logs"), path("queries.csv"), path("predicted.csv")}),
                path("learned.net"), {"own pose"});

    TrainSensorRequest camera = request(path("logs"), "camera");
    camera.overwrite = true;
    const auto subjects = trainSensor(camera);
    ASSERT_TRUE(subjects) << subjects.error().message();
    EXPECT_EQ(subjects->network.measures, SensorNetwork::Measures::subjects);
    EXPECT_TRUE(subjects->network.landmarks);
    EXPECT_FALSE(subjects->network.robotSubjects);
    EXPECT_NEAR(toSeconds(subjects->network.latency), 0.06, 0.02);
    EXPECT_NEAR(subjects->network.view.fieldOfView, 1.2, 0.05);
}

TEST_F(TrainSensor, TheGivenLatencyCounts) {
    TrainSensorRequest given = request(write("log.csv", plantedSensorLog({})), "slam");
    given.latency = 0.25;
    const auto trained = trainSensor(given);
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_EQ(trained->network.latency, 250'000'000);
}

TEST_F(TrainSensor, SaysWhereTheLatencyIsNotKnown) {
    const auto trained = trainSensor(request(write("log.csv", plantedSensorLog({.turns = false})), "camera"));
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_EQ(trained->network.latency, 0);
    ASSERT_EQ(trained->notices.size(), 1u);
    EXPECT_NE(trained->notices[0].find("latency is not known, and taken as 0: "), std::string::npos);
}

TEST_F(TrainSensor, SaysWhereStampsAreEarly) {
    const auto trained = trainSensor(request(write("log.csv", plantedSensorLog({.lateness = -0.2})), "slam"));
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_EQ(trained->network.latency, 0);
    ASSERT_EQ(trained->notices.size(), 1u);
    EXPECT_NE(trained->notices[0].find("is taken as 0 ms"), std::string::npos) << trained->notices[0];
}

TEST_F(TrainSensor, ChosenRobotsMayBeOfDifferentLogs) {
    Log one = plantedSensorLog({}), other = plantedSensorLog({.seed = 2});
    for (RobotLog& robot : other.robots) robot.robot += "_again";
    TrainSensorRequest both = request(write("one.csv", one), "slam");
    both.logs.push_back(write("other.csv", other));
    both.robots = {one.robots[0].robot, other.robots[0].robot};
    const auto trained = trainSensor(both);
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_EQ(trained->network.robots, both.robots);
}

TEST_F(TrainSensor, LeavesOutWhatAFalseTruthWouldSay) {
    PlantedSensors plant;
    plant.headingOffset = [](double seconds) { return seconds > 100 && seconds < 130 ? 0.08 : 0.0; };
    const auto trained = trainSensor(request(write("log.csv", plantedSensorLog(plant)), "camera"));
    ASSERT_TRUE(trained) << trained.error().message();
    ASSERT_EQ(trained->notices.size(), 1u);
    EXPECT_NE(trained->notices[0].find("at which the ground truth was off"), std::string::npos);
    // 30 s at 0.2 s a look
    EXPECT_NEAR(std::stod(trained->notices[0].substr(std::string("Left out: ").size())), 150, 5);
    EXPECT_LT(trained->network.constant.spread[1], 2 * plant.bearingNoise);
}

TEST_F(TrainSensor, RefusesWithOneLine) {
    const std::string log = write("log.csv", plantedSensorLog({}));
    expectError(trainSensor(request(log, "gps")), log, {"has no sensor \"gps\"; it has camera, slam"});
    TrainSensorRequest other = request(log, "slam");
    other.robots = {"nobody"};
    expectError(trainSensor(other), log, {"has no robot \"nobody\""});
    expectError(trainSensor(request(write("short.csv", plantedSensorLog({.seconds = 20})), "slam")), path("short.csv"),
                {"learning needs 200"});
    Log bare = plantedSensorLog({.seconds = 20}), scanning = plantedSensorLog({.seconds = 20});
    bare.robots[0].trajectories[0].sensors.clear();
    bare.subjects.clear();
    expectError(trainSensor(request(write("bare.csv", bare), "slam")), path("bare.csv"), {"holds no measurements"});
    std::vector<SensorLog>& sensors = scanning.robots[0].trajectories[0].sensors;
    expectError(trainSensor(request(write("placeless.csv", withoutTruth()), "slam")), path("placeless.csv"),
                {"holds 0 readings of what is known"});
    sensors = {{.sensor = "laser", .scans = {{planted::instant(2), -1, 1, {1, 2, 3}}}}};
    expectError(trainSensor(request(write("scans.csv", scanning), "laser")), path("scans.csv"),
                {"\"laser\" reports scans, which cannot be learned"});
    Log shifted = plantedSensorLog({});
    for (RobotLog& robot : shifted.robots)
        for (SensorLog& sensor : robot.trajectories[0].sensors)
            for (Look& look : sensor.looks) look.time += fromSeconds(20);
    for (StampedPose& pose : shifted.robots[0].trajectories[0].sensors[1].poses) pose.time += fromSeconds(20);
    expectError(trainSensor(request(write("shifted.csv", shifted), "camera")), path("shifted.csv"),
                {"\"camera\" do not fit the ground truth", "another clock"});
    expectError(trainSensor(request(path("shifted.csv"), "slam")), path("shifted.csv"),
                {"\"slam\" do not fit the ground truth", "how the robot truly moved", "another clock"});
    Log placeless = plantedSensorLog({});
    for (LogSubject& subject : placeless.subjects) subject.position.reset();
    expectError(trainSensor(request(write("unknown.csv", placeless), "camera")), path("unknown.csv"),
                {"holds 0 readings of what is known", "Nothing says where"});
    EXPECT_FALSE(std::filesystem::exists(path("learned.net")));
}

}  // namespace
}  // namespace mrose
