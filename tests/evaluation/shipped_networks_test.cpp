// What the networks in nets/ promise.
#include <cmath>
#include <filesystem>
#include <map>

#include <gtest/gtest.h>

#include "evaluation/evaluate.h"
#include "io/file.h"
#include "logs/log_reader.h"
#include "motion/learned_model.h"
#include "support/places.h"
#include "support/test_data.h"

namespace mrose {
namespace {

const std::filesystem::path nets = sourceFolder() / "nets";

std::shared_ptr<const LearnedMotion> shipped(const char* file) {
    const auto network = loadNetwork(nets / file);
    EXPECT_TRUE(network) << network.error().message();
    return network ? std::make_shared<const LearnedMotion>(*network) : nullptr;
}

Summary openLoop(const std::shared_ptr<const LearnedMotion>& motion, const Log& log,
                 const std::vector<std::string>& robots) {
    std::map<std::string, LearnedModel> models;
    for (const RobotLog& robot : log.robots) models.try_emplace(robot.robot, motion, robot.robot);
    const NamedModel named{"shipped", [&](const std::string& robot) { return &models.at(robot); }};
    EvaluationOptions options;
    options.robots = robots;
    options.withFloor = false;
    const auto evaluation = evaluate(log, std::span(&named, 1), options);
    EXPECT_TRUE(evaluation);
    return evaluation->models[0].all;
}

TEST(ShippedNetworks, AreWrittenAsTheProgramWritesThem) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(nets)) {
        if (entry.path().extension() != ".net") continue;
        ++count;
        const auto network = loadNetwork(entry.path());
        ASSERT_TRUE(network) << network.error().message();
        EXPECT_EQ(networkText(*network), *readFile(entry.path())) << entry.path();
        EXPECT_FALSE(network->training.logs.empty()) << entry.path();
        EXPECT_EQ(network->training.command.substr(0, 12), "mrose train ") << entry.path();
    }
    EXPECT_GE(count, 4);
}

TEST(ShippedNetworks, CreateMeetsItsBoundsOnDataThatNothingWasChosenOn) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    const auto log = readLog(*data / "mrclam" / "MRCLAM_Dataset7");
    ASSERT_TRUE(log) << log.error().message();
    const Summary ours = openLoop(shipped("create.net"), *log, {"1", "2"});
    EXPECT_EQ(ours.windows, 162u);
    EXPECT_LT(ours.p, 2.0);
    EXPECT_LT(ours.hd, 4.6);
    EXPECT_GT(ours.p, 1.2) << "below the floor: something reads what it may not";
    const Summary paper = openLoop(shipped("create_paper.net"), *log, {"1", "2"});
    EXPECT_LT(paper.p, 3.0);
    EXPECT_LT(paper.hd, 6.5);
}

TEST(ShippedNetworks, CreateForgetsAWrongStartVelocityWithinASecond) {
    const LearnedModel model(shipped("create.net"), "1");
    CommandHistory history;
    history.issue(0, {0.067, 0.1});
    constexpr Nanoseconds period = 100'000'000;
    MotionStep settled;
    for (int k = 0; k < 30; ++k)
        settled = model.predictOne({&history, k * period, settled.velocity, settled.unperturbed});
    for (const auto& [dv, dw] : {std::pair{0.05, 0.3}, {-0.05, -0.3}, {0.05, -0.3}, {-0.05, 0.3}}) {
        MotionStep wrong = settled, right = settled;
        wrong.velocity.v += dv;
        wrong.velocity.w += dw;
        Pose a, b;
        for (int k = 30; k < 40; ++k) {
            right = model.predictOne({&history, k * period, right.velocity, right.unperturbed});
            wrong = model.predictOne({&history, k * period, wrong.velocity, wrong.unperturbed});
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
