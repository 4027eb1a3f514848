// Holding out of learning, and judging by what was held out.
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "cli/workshop.h"
#include "identification/held_out_part.h"
#include "identification/planted_log.h"
#include "logs/csv_writer.h"
#include "logs/log_reader.h"
#include "motion/input_reader.h"
#include "motion/motion_network.h"
#include "support/test_data.h"

namespace mrose {
namespace {

using HeldOutProgram = Workshop;
using Json = nlohmann::json;

TEST_F(HeldOutProgram, EvaluatesOnlyWhatWasHeldOut) {
    auto words = trainWords(path("half.net"));
    words.insert(words.end(), {"--hold-out", "0.5"});
    ASSERT_EQ(runMrose(words).status, 0);
    const auto network = loadNetwork(path("half.net"));
    ASSERT_TRUE(network) << network.error().message();
    EXPECT_TRUE((network->heldOut.part == HoldOut{2, 1}));

    const auto windowsOf = [&](std::vector<std::string> more) {
        std::vector<std::string> all{"evaluate", path("half.net"), "--log", log(), "--no-floor", "--json"};
        all.insert(all.end(), more.begin(), more.end());
        const ProgramResult result = runMrose(all);
        EXPECT_EQ(result.status, 0) << result.err;
        const Json json = Json::parse(result.out, nullptr, false);
        return json["models"][0]["all"]["windows"].get<int>();
    };
    const int everything = windowsOf({}), heldOut = windowsOf({"--held-out"});
    EXPECT_GT(heldOut, 0);
    EXPECT_EQ(2 * heldOut, everything);  // two of the four runs
}

TEST_F(HeldOutProgram, ThePartsAreDifferentGroups) {
    auto words = trainWords(path("other.net"));
    words.insert(words.end(), {"--hold-out", "0.5", "--hold-out-part", "1"});
    ASSERT_EQ(runMrose(words).status, 0);
    EXPECT_TRUE((loadNetwork(path("other.net"))->heldOut.part == HoldOut{2, 0}));
}

TEST_F(HeldOutProgram, NothingWasHeldOut) {
    expectOneLine(runMrose({"evaluate", network(), "--log", log(), "--held-out"}), {network(), "--hold-out"});
}

TEST_F(HeldOutProgram, AnotherLogIsNotJudgedByItsHeldOutPart) {
    auto words = trainWords(path("half.net"));
    words.insert(words.end(), {"--hold-out", "0.5"});
    ASSERT_EQ(runMrose(words).status, 0);
    const std::string other = write("other.csv", plantedCsv() + "# another hash\n");
    expectOneLine(runMrose({"evaluate", path("half.net"), "--log", other, "--held-out"}), {other, "half.net"});
}

TEST_F(HeldOutProgram, WrongSharesAreRefused) {
    for (const std::string share : {"0", "0.9", "-1", "some", "nan"}) {
        auto words = trainWords(path("x.net"));
        words.insert(words.end(), {"--hold-out", share});
        expectOneLine(runMrose(words), {"--hold-out", share}, 2);
    }
    auto words = trainWords(path("x.net"));
    words.insert(words.end(), {"--hold-out-part", "1"});
    expectOneLine(runMrose(words), {"--hold-out-part", "--hold-out"}, 2);
    EXPECT_EQ(read("x.net"), "");
}

TEST_F(HeldOutProgram, NoGroupForSoSmallAShareIsAnError) {
    auto words = trainWords(path("x.net"));
    words.insert(words.end(), {"--hold-out", "0.01"});
    expectOneLine(runMrose(words), {log(), "no group of trajectories to hold out"});
    EXPECT_EQ(read("x.net"), "");
}

/// One drive of five minutes.
std::string longCsv() {
    Log log;
    RobotLog robot;
    robot.robot = "planted";
    Plant plant;
    plant.duration = 300;
    robot.trajectories.push_back(plantedTrajectory(plant));
    log.robots.push_back(std::move(robot));
    return toCsv(log);
}

TEST_F(HeldOutProgram, BlocksOfTimeAreHeldOutOfOneLongTrajectory) {
    const std::string drive = write("drive.csv", longCsv());
    auto words = trainWords(drive, path("blocks.net"));
    words.insert(words.end(), {"--hold-out", "0.2"});
    const ProgramResult trained = runMrose(words);
    ASSERT_EQ(trained.status, 0) << trained.err;
    EXPECT_THAT(trained.out, testing::HasSubstr("kept from learning, for mrose evaluate --held-out: one in 5 of the "
                                                "blocks of about 44 s; nor was learned from "));
    const auto network = loadNetwork(path("blocks.net"));
    ASSERT_TRUE(network) << network.error().message();
    const HoldOut part = network->heldOut.part;
    EXPECT_TRUE(part.every == 5 && part.offset == 4 && part.block == 44);
    const double reach = toSeconds(InputReader(*network).lookBack()) + 2;  // 20 periods
    EXPECT_GE(part.guard, reach);
    EXPECT_LT(part.guard, reach + 0.5);

    const ProgramResult judged = runMrose(
        {"evaluate", path("blocks.net"), "--log", drive, "--held-out", "--no-floor", "--report", path("report"), "-q"});
    ASSERT_EQ(judged.status, 0) << judged.err;
    const std::string windows = read("report/windows.csv");
    const auto log = readLog(drive);
    ASSERT_TRUE(log);
    const auto blocks = heldOutBlocks(log->robots[0].trajectories[0], part);
    ASSERT_EQ(blocks.size(), 1u);
    std::istringstream lines(windows);
    std::string line;
    std::getline(lines, line);
    int count = 0;
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        std::string cell;
        for (int i = 0; i < 3; ++i) std::getline(cells, cell, ',');
        const double start = std::stod(cell);
        EXPECT_GE(start, toSeconds(blocks[0].first));
        EXPECT_LE(start + 10, toSeconds(blocks[0].second));
        ++count;
    }
    EXPECT_GE(count, 4) << windows;
    // The windows are the whole log's, too.
    EXPECT_EQ(runMrose({"predict", path("blocks.net"), "--log", drive, "--windows", path("report/windows.csv"), "-o",
                        path("predicted.csv"), "-q"})
                  .status,
              0);
}

TEST_F(HeldOutProgram, TruthThatIsHeldOutChangesNothingThatIsLearned) {
    const std::string drive = write("drive.csv", longCsv());
    auto log = readLog(drive);
    ASSERT_TRUE(log);
    Trajectory& trajectory = log->robots[0].trajectories[0];
    const auto blocks = heldOutBlocks(trajectory, {5, 4, 44});
    ASSERT_EQ(blocks.size(), 1u);
    for (StampedPose& pose : trajectory.poses)
        if (pose.time >= blocks[0].first && pose.time < blocks[0].second) pose.pose.x += 0.05;
    const std::string garbled = write("garbled.csv", toCsv(*log));
    for (const auto& [from, to] : {std::pair{drive, "a.net"}, {garbled, "b.net"}}) {
        auto words = trainWords(from, path(to));
        words.insert(words.end(), {"--hold-out", "0.2"});
        ASSERT_EQ(runMrose(words).status, 0);
    }
    auto a = loadNetwork(path("a.net")), b = loadNetwork(path("b.net"));
    ASSERT_TRUE(a && b);
    b->training = a->training;  // the command and the hash differ
    EXPECT_TRUE(*a == *b);
}

TEST_F(HeldOutProgram, GroupsOrTimeCanBeAskedFor) {
    const std::string drive = write("drive.csv", longCsv());
    auto words = trainWords(drive, path("x.net"));
    words.insert(words.end(), {"--hold-out", "0.2", "--hold-out-by", "groups"});
    expectOneLine(runMrose(words), {drive, "has no group of trajectories to hold out"});
    words = trainWords(path("x.net"));
    words.insert(words.end(), {"--hold-out", "0.5", "--hold-out-by", "time"});
    expectOneLine(runMrose(words), {log(), "too short", "needs 40 s", "longest has 24 s"});
    words = trainWords(path("x.net"));
    words.insert(words.end(), {"--hold-out-by", "time"});
    expectOneLine(runMrose(words), {"--hold-out-by", "--hold-out"}, 2);
    words.insert(words.end(), {"--hold-out", "0.5", "--hold-out-by", "luck"});
    EXPECT_EQ(runMrose(words).status, 2);
    EXPECT_EQ(read("x.net"), "");
}

TEST_F(HeldOutProgram, HuskyOfEveryFifthStepIsPredictedFromTheOthers) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs beside the repository";
    const std::string windows = (*data / "drive" / "husky_windows.csv").string();
    ASSERT_EQ(runMrose({"train", windows, "-q", "--hold-out", "0.2", "--hidden", "16", "--members", "2", "--epochs",
                        "200", "-o", path("h.net")})
                  .status,
              0);
    const ProgramResult result =
        runMrose({"evaluate", path("h.net"), "--log", windows, "--held-out", "--no-floor", "--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json json = Json::parse(result.out, nullptr, false);
    const auto steady = [&](std::size_t model) {
        for (const Json& group : json["models"][model]["groups"])
            if (group["name"] == "steady") return group["summary"];
        return Json();
    };
    EXPECT_EQ(steady(0)["windows"], 80);
    const auto median = [&](std::size_t model) {
        return steady(model)["position_final_over_path_by_steps_percent"]["median"].get<double>();
    };
    EXPECT_LT(median(0), 21);                // a network in a hurry
    EXPECT_LT(median(0), 0.75 * median(1));  // against velocity = command
    EXPECT_LT(steady(0)["position_final_over_path_by_steps_percent"]["median"],
              steady(0)["position_final_over_path_percent"]["median"]);
}

}  // namespace
}  // namespace mrose
