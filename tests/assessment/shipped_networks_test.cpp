// What the networks in nets/ promise.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "assessment/evaluate.h"
#include "identification/held_out_part.h"
#include "io/file.h"
#include "learning/network_file.h"
#include "learning/task_network.h"
#include "logs/log_reader.h"
#include "motion/learned_model.h"
#include "perception/sensor_network.h"
#include "support/places.h"
#include "support/test_data.h"
#include "synthetic/log_generator.h"

namespace mrose {
namespace {

const std::filesystem::path nets = sourceFolder() / "nets";

std::shared_ptr<const LearnedMotion> shipped(const char* file) {
    const auto network = loadNetwork(nets / file);
    EXPECT_TRUE(network) << network.error().message();
    return network ? std::make_shared<const LearnedMotion>(*network) : nullptr;
}

Assessment openLoop(const std::shared_ptr<const LearnedMotion>& motion, const Log& log,
                    const std::vector<std::string>& robots = {}) {
    std::map<std::string, LearnedModel> models;
    for (const RobotLog& robot : log.robots) models.try_emplace(robot.robot, motion, robot.robot);
    const NamedModel named{"shipped", [&](const std::string& robot) { return &models.at(robot); }};
    EvaluationOptions options;
    options.robots = robots;
    options.withFloor = false;
    const auto evaluation = evaluate(log, std::span(&named, 1), options);
    EXPECT_TRUE(evaluation);
    return evaluation->models[0];
}

Summary partOf(const Assessment& evaluation, const std::string& name) {
    for (const GroupSummary& group : evaluation.groups)
        if (group.name == name) return group.summary;
    ADD_FAILURE() << "no windows of " << name;
    return {};
}

TEST(ShippedNetworks, AreWrittenAsTheProgramWritesThem) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(nets)) {
        if (entry.path().extension() != ".net") continue;
        ++count;
        const std::string text = *readFile(entry.path());
        NetworkTraining training;
        if (networkKind(text) == SensorNetwork::kind) {
            const auto sensor = loadSensor(entry.path());
            ASSERT_TRUE(sensor) << sensor.error().message();
            EXPECT_EQ(sensorText(*sensor), text) << entry.path();
            training = sensor->learned.training;
        } else if (networkKind(text) == TaskNetwork::kind) {
            const auto task = parseTask(text, entry.path().string());
            ASSERT_TRUE(task) << task.error().message();
            EXPECT_EQ(taskFileText(*task), text) << entry.path();
            training = task->learned.training;
        } else {
            const auto network = loadNetwork(entry.path());
            ASSERT_TRUE(network) << network.error().message();
            EXPECT_EQ(networkText(*network), text) << entry.path();
            training = network->training;
        }
        EXPECT_FALSE(training.logs.empty()) << entry.path();
        const bool task = networkKind(text) == TaskNetwork::kind;
        EXPECT_TRUE(training.command.starts_with(task ? "mrose learn " : "mrose train ")) << entry.path();
    }
    EXPECT_GE(count, 5);
}

TEST(ShippedNetworks, CreateMeetsItsBoundsOnDataThatNothingWasChosenOn) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    const auto log = readLog(*data / "mrclam" / "MRCLAM_Dataset7");
    ASSERT_TRUE(log) << log.error().message();
    const Summary ours = openLoop(shipped("create.net"), *log, {"1", "2"}).all;
    EXPECT_EQ(ours.windows, 162u);
    EXPECT_LT(ours.p, 1.72) << "1.78 by a network that is not told how the tracked points lie";
    EXPECT_LT(ours.hd, 4.6);
    EXPECT_GT(ours.p, 1.2) << "below the floor: something reads what it may not";
    const Summary paper = openLoop(shipped("create_paper.net"), *log, {"1", "2"}).all;
    EXPECT_LT(paper.p, 3.0);
    EXPECT_LT(paper.hd, 6.5);
}

TEST(ShippedNetworks, HuskyMeetsItsBoundOnCommandsItHasNotSeen) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    const auto husky = shipped("husky.net");
    LogOptions options;
    options.drive = *husky->network().drive;
    auto log = readLog(*data / "drive" / "husky_windows.csv", options);
    ASSERT_TRUE(log) << log.error().message();
    log = partOf(std::move(*log), husky->network().heldOut.part, LogPart::heldOut);
    ASSERT_TRUE(log);
    const Summary steady = partOf(openLoop(husky, *log), "steady");
    EXPECT_EQ(steady.windows, 80u);
    // The bound of 16 % is met over all five fifths; of one fifth the median is known to about 1.5 %.
    EXPECT_LT(steady.positionFinalOverPathBySteps.median, 17.5);
    EXPECT_GT(steady.positionFinalOverPathBySteps.median, 12) << "better than repeated runs agree";
}

TEST(ShippedNetworks, PioneerMeetsItsBoundsOnDrivesItHasNotSeen) {
    const auto pioneer = shipped("pioneer.net");
    double error = 0, path = 0;
    std::size_t windows = 0, switches = 0;
    const auto sets = syntheticSets();
    const auto set = std::find_if(sets.begin(), sets.end(), [](const SyntheticSet& s) { return s.name == "held-out"; });
    ASSERT_NE(set, sets.end());
    for (const SyntheticPart& part : set->parts) {
        const auto log = generateLog(part, 2);
        ASSERT_TRUE(log);
        const Assessment evaluation = openLoop(pioneer, *log);
        windows += evaluation.all.windows;
        error += evaluation.all.p * evaluation.all.path;
        path += evaluation.all.path;
        if (part.pattern != DrivePattern::hardSwitch) continue;
        switches += evaluation.all.windows;
        EXPECT_LT(evaluation.all.p, 10);
    }
    EXPECT_EQ(windows, 100u);
    EXPECT_GE(switches, 10u);
    EXPECT_LT(error / path, 2.0);
    EXPECT_GT(error / path, 0.9 / std::numbers::sqrt2) << "repeated runs are 0.9 % apart: better than any mean";
    EXPECT_GE(pioneer->network().training.patterns, 100'000);
}

TEST(ShippedNetworks, CreateForgetsAWrongStartVelocityWithinASecond) {
    const LearnedModel model(shipped("create.net"), "1");
    CommandHistory history;
    history.issue(0, {0.067, 0.1});
    constexpr Nanoseconds period = 100'000'000;
    std::vector<std::byte> memory(model.memorySize());
    MotionStep settled;
    for (int k = 0; k < 30; ++k) settled = model.predictOne({&history, k * period, settled.velocity, memory});
    for (const auto& [dv, dw] : {std::pair{0.05, 0.3}, {-0.05, -0.3}, {0.05, -0.3}, {-0.05, 0.3}}) {
        MotionStep wrong = settled, right = settled;
        std::vector<std::byte> wrongMemory = memory, rightMemory = memory;
        wrong.velocity.v += dv;
        wrong.velocity.w += dw;
        Pose a, b;
        for (int k = 30; k < 40; ++k) {
            right = model.predictOne({&history, k * period, right.velocity, rightMemory});
            wrong = model.predictOne({&history, k * period, wrong.velocity, wrongMemory});
            a = a * right.increment;
            b = b * wrong.increment;
        }
        EXPECT_NEAR(wrong.velocity.v, right.velocity.v, 0.002);
        EXPECT_NEAR(wrong.velocity.w, right.velocity.w, 0.012);
        // A drive with a lag of 30 to 200 ms is carried on by that lag times the velocity, in the velocity's
        // direction.
        EXPECT_GT((b.x - a.x) / dv, 0.01);
        EXPECT_LT((b.x - a.x) / dv, 0.25);
        EXPECT_GT((b.heading - a.heading) / dw, 0.01);
        EXPECT_LT((b.heading - a.heading) / dw, 0.25);
    }
}

}  // namespace
}  // namespace mrose
