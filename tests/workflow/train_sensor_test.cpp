#include "workflow/train_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "geometry/pose.h"
#include "identification/planted_sensors.h"
#include "io/file.h"
#include "logs/csv_writer.h"
#include "logs/pose_grid.h"
#include "perception/learned_sensor.h"
#include "perception/logged_view.h"
#include "support/temporary_folder.h"
#include "workflow/expect_error.h"
#include "workflow/generate_logs.h"
#include "workflow/log_files.h"
#include "workflow/predict_readings.h"
#include "world/seconds_text.h"

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

/// A row of predicted own poses.
struct PredictedPose {
    std::string robot, time;
    double probability = 0;
    int sample = 0;
    Pose pose;
};

std::vector<PredictedPose> predictedPoses(const std::string& file) {
    std::istringstream lines(*readFile(file));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "robot,t,p_report,sample,x,y,heading");
    std::vector<PredictedPose> rows;
    while (std::getline(lines, line)) {
        std::ranges::replace(line, ',', ' ');
        PredictedPose row;
        std::istringstream(line) >> row.robot >> row.time >> row.probability >> row.sample >> row.pose.x >>
            row.pose.y >> row.pose.heading;
        rows.push_back(row);
    }
    return rows;
}

TEST_F(TrainSensor, OwnPosesArePredictedAsTheModelHasThem) {
    const std::string log = write("log.csv", plantedSensorLog({}));
    const auto trained = trainSensor(request(log, "slam"));
    ASSERT_TRUE(trained) << trained.error().message();
    const auto file = [&](const std::string& name, const std::string& text) {
        EXPECT_TRUE(writeFileAtomically(path(name), text));
        return path(name);
    };
    const auto truth = openLog(log, {});
    ASSERT_TRUE(truth);
    const std::string robot = truth->robots[0].robot;
    const std::vector<StampedPose>& poses = truth->robots[0].trajectories[0].poses;
    const std::array times{poses.front().time + fromSeconds(12.3), poses.front().time + fromSeconds(40.25)};
    std::string queries = "t,why,robot\n";
    for (const Nanoseconds time : times) queries += secondsText(time) + ",because," + robot + '\n';
    PredictReadingsRequest asked{path("learned.net"), log, file("queries.csv", queries), path("predicted.csv")};
    constexpr std::size_t samples = 10000;
    asked.samples = static_cast<int>(samples);
    const auto predicted = predictReadings(asked);
    ASSERT_TRUE(predicted) << predicted.error().message();
    EXPECT_EQ(predicted->queries, 2u);
    const std::vector<PredictedPose> rows = predictedPoses(asked.output);
    ASSERT_EQ(rows.size(), 2 * samples);

    const LoggedView view(*truth);
    const LearnedSensor sensor(trained->network);
    for (std::size_t query = 0; query < 2; ++query) {
        SCOPED_TRACE(query);
        const Nanoseconds measured = times[query] - trained->network.latency;
        SensedState state;
        state.own = truthAt(poses, measured);
        state.velocity = view.velocityOf(0, 0, measured);
        ReadingDistribution expected;
        sensor.distributions({&state, 1}, sensor.robotIndex(robot), {&expected, 1});
        std::array<std::vector<double>, 3> below;
        for (std::size_t i = samples * query; i < samples * (query + 1); ++i) {
            EXPECT_EQ(rows[i].sample, static_cast<int>(i % samples));
            EXPECT_EQ(rows[i].time, secondsText(times[query]));
            EXPECT_NEAR(rows[i].probability, expected.probability(), 1e-5);
            const Pose off = relative(state.own, rows[i].pose);
            const std::array error{off.x, off.y, wrapAngle(off.heading)};
            for (std::size_t d = 0; d < 3; ++d)
                below[d].push_back(expected.probabilityBelow(static_cast<int>(d), error[d]));
        }
        // Even from 0 to 1, by Kolmogorov and Smirnov: 1 in 1000 is farther off.
        for (std::vector<double>& part : below) {
            std::ranges::sort(part);
            double most = 0;
            for (std::size_t i = 0; i < part.size(); ++i)
                most = std::max(most, std::abs(part[i] - (static_cast<double>(i) + 0.5) / samples));
            EXPECT_LT(most, 1.95 / std::sqrt(static_cast<double>(samples)));
        }
    }

    asked.overwrite = true;
    asked.queries = file("of_nobody.csv", "robot,t\nnobody," + secondsText(times[0]) + "\n");
    expectError(predictReadings(asked), asked.queries, {"2", "no robot nobody"});
    PredictReadingsRequest ofNobody = asked;
    ofNobody.robots = {"nobody"};
    expectError(predictReadings(ofNobody), log, {"has no robot \"nobody\""});
    asked.queries = file("too_late.csv", "robot,t\n" + robot + ",99999\n");
    expectError(predictReadings(asked), asked.queries, {"2", "no ground truth"});
    asked.queries = file("without_time.csv", "robot,dataset\n" + robot + ",0\n");
    expectError(predictReadings(asked), asked.queries, {"1", "expected robot,t"});
    asked.queries = file("none.csv", "robot,t\n");
    expectError(predictReadings(asked), asked.queries, {"asks nothing"});
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
                {"\"camera\" of robot a do not fit the ground truth", "another clock"});
    expectError(trainSensor(request(path("shifted.csv"), "slam")), path("shifted.csv"),
                {"\"slam\" of robot a do not fit the ground truth", "how the robot truly moved", "another clock"});
    // among good ones, too
    Log team = plantedSensorLog({});
    team.robots.push_back({"b", shifted.robots[0].trajectories, {}});
    for (const char* const sensor : {"camera", "slam"}) {
        TrainSensorRequest some = request(log, sensor);
        some.logs.push_back(write("longer.csv", plantedSensorLog({.seconds = 500, .seed = 2})));
        some.logs.push_back(path("shifted.csv"));
        expectError(trainSensor(some), path("shifted.csv"), {std::string(sensor) + "\" of robot a do not fit"});
        expectError(trainSensor(request(write("team.csv", team), sensor)), path("team.csv"),
                    {"\" of robot b do not fit"});
    }
    Log inDegrees = plantedSensorLog({});
    for (StampedPose& pose : inDegrees.robots[0].trajectories[0].poses) pose.pose.heading *= 57.3;
    expectError(trainSensor(request(write("degrees.csv", inDegrees), "camera")), path("degrees.csv"),
                {"\"camera\" of robot a do not fit", "headings are expected in radians, not in degrees"});
    Log placeless = plantedSensorLog({});
    for (LogSubject& subject : placeless.subjects) subject.position.reset();
    expectError(trainSensor(request(write("unknown.csv", placeless), "camera")), path("unknown.csv"),
                {"holds 0 readings of what is known", "Nothing says where"});
    EXPECT_FALSE(std::filesystem::exists(path("learned.net")));
}

}  // namespace
}  // namespace mrose
