// Holding out of learning, and judging by what was held out.
#include "identification/held_out_part.h"
#include "identification/planted_log.h"
#include "logs/csv_writer.h"
#include "logs/log_reader.h"
#include "motion/input_reader.h"
#include "support/test_data.h"
#include "support/workshop.h"
#include "workflow/evaluate_network.h"
#include "workflow/expect_error.h"
#include "workflow/predict_windows.h"
#include "workflow/train_network.h"

namespace mrose {
namespace {

class HeldOut : public Workshop {
protected:
    /// Learned from all of the log but so large a share.
    static Expected<TrainedNetwork> learned(const std::string& log, double share, const std::string& out = "",
                                            HoldOutBy by = HoldOutBy::whatSuits, int part = 0) {
        TrainRequest request = training(log, out);
        request.logs.holdOut = share;
        request.logs.holdOutBy = by;
        request.logs.holdOutPart = part;
        return trainNetwork(request);
    }
    static EvaluateRequest judging(const std::string& net, const std::string& log, bool heldOut) {
        EvaluateRequest request{net, log};
        request.withFloor = false;
        request.heldOut = heldOut;
        return request;
    }
};

TEST_F(HeldOut, OnlyThatIsEvaluated) {
    const auto trained = learned(log(), 0.5, path("half.net"));
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_TRUE((trained->network.heldOut.part == HoldOut{2, 1}));
    const auto everything = evaluateNetwork(judging(path("half.net"), log(), false)),
               heldOut = evaluateNetwork(judging(path("half.net"), log(), true));
    ASSERT_TRUE(everything && heldOut);
    EXPECT_GT(heldOut->evaluation.log.windows.size(), 0u);
    EXPECT_EQ(2 * heldOut->evaluation.log.windows.size(),
              everything->evaluation.log.windows.size());  // two of the four runs
}

TEST_F(HeldOut, PartsAreDifferentGroups) {
    const auto trained = learned(log(), 0.5, "", HoldOutBy::whatSuits, 1);
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_TRUE((trained->network.heldOut.part == HoldOut{2, 0}));
}

TEST_F(HeldOut, NothingWasOfANetworkOfAllLogs) {
    expectError(evaluateNetwork(judging(network(), log(), true)), network(), {"--hold-out"});
}

TEST_F(HeldOut, AnotherLogIsNotJudgedByIt) {
    ASSERT_TRUE(learned(log(), 0.5, path("half.net")));
    const std::string other = write("other.csv", plantedCsv() + "# another hash\n");
    expectError(evaluateNetwork(judging(path("half.net"), other, true)), other, {"half.net"});
}

TEST_F(HeldOut, NoGroupForSoSmallAShareIsAnError) {
    expectError(learned(log(), 0.01, path("x.net")), log(), {"no group of trajectories to hold out"});
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

TEST_F(HeldOut, BlocksOfTimeOfOneLongTrajectory) {
    const std::string drive = write("drive.csv", longCsv());
    const auto trained = learned(drive, 0.2, path("blocks.net"));
    ASSERT_TRUE(trained) << trained.error().message();
    const HoldOut part = trained->network.heldOut.part;
    EXPECT_TRUE(part.every == 5 && part.offset == 4 && part.block == 44);
    const double reach = toSeconds(InputReader(trained->network).lookBack()) + 2;  // 20 periods
    EXPECT_GE(part.guard, reach);
    EXPECT_LT(part.guard, reach + 0.5);

    const auto judged = evaluateNetwork(judging(path("blocks.net"), drive, true));
    ASSERT_TRUE(judged) << judged.error().message();
    const auto log = readLog(drive);
    ASSERT_TRUE(log);
    const auto blocks = heldOutBlocks(log->robots[0].trajectories[0], part);
    ASSERT_EQ(blocks.size(), 1u);
    EXPECT_GE(judged->evaluation.log.windows.size(), 4u);
    for (const Window& window : judged->evaluation.log.windows) {
        EXPECT_GE(window.start, blocks[0].first);
        EXPECT_LE(window.start + 10 * nanosecondsPerSecond, blocks[0].second);
    }
}

TEST_F(HeldOut, TruthChangesNothingThatIsLearned) {
    const std::string drive = write("drive.csv", longCsv());
    auto log = readLog(drive);
    ASSERT_TRUE(log);
    Trajectory& trajectory = log->robots[0].trajectories[0];
    const auto blocks = heldOutBlocks(trajectory, {5, 4, 44});
    ASSERT_EQ(blocks.size(), 1u);
    for (StampedPose& pose : trajectory.poses)
        if (pose.time >= blocks[0].first && pose.time < blocks[0].second) pose.pose.x += 0.05;
    auto a = learned(drive, 0.2), b = learned(write("garbled.csv", toCsv(*log)), 0.2);
    ASSERT_TRUE(a && b);
    b->network.training = a->network.training;  // the hash differs
    EXPECT_TRUE(a->network == b->network);
}

TEST_F(HeldOut, GroupsOrTimeCanBeAskedFor) {
    const std::string drive = write("drive.csv", longCsv());
    expectError(learned(drive, 0.2, "", HoldOutBy::groups), drive, {"has no group of trajectories to hold out"});
    expectError(learned(log(), 0.5, "", HoldOutBy::time), log(), {"too short", "needs 40 s", "longest has 24 s"});
}

TEST_F(HeldOut, HuskyOfEveryFifthStepIsPredictedFromTheOthers) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs beside the repository";
    const std::string windows = (*data / "drive" / "husky_windows.csv").string();
    TrainRequest request;
    request.logs.sources = {windows};
    request.logs.holdOut = 0.2;
    request.output = path("h.net");
    request.hidden = 16;
    request.members = 2;
    request.epochs = 200;
    ASSERT_TRUE(trainNetwork(request));
    const auto judged = evaluateNetwork(judging(path("h.net"), windows, true));
    ASSERT_TRUE(judged) << judged.error().message();
    const auto steady = [&](std::size_t model) {
        for (const GroupSummary& group : judged->evaluation.models[model].groups)
            if (group.name == "steady") return group.summary;
        return Summary{};
    };
    EXPECT_EQ(steady(0).windows, 80);
    const auto median = [&](std::size_t model) { return steady(model).positionFinalOverPathBySteps.median; };
    EXPECT_LT(median(0), 21);                // a network in a hurry
    EXPECT_LT(median(0), 0.75 * median(1));  // against velocity = command
    EXPECT_LT(median(0), steady(0).positionFinalOverPath.median);
}

}  // namespace
}  // namespace mrose
