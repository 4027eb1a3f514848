#include "assessment/compare.h"

#include <cmath>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "assessment/played_scenarios.h"
#include "assessment/prediction_files.h"
#include "assessment/test_models.h"
#include "logs/log_reader.h"
#include "report/comparison_files.h"
#include "report/evaluation_files.h"
#include "support/test_data.h"

namespace mrose {
namespace {

Command weaveAlong(double t) { return {0.15 + 0.05 * std::sin(t), 0.3 * std::cos(2 * t)}; }

/// Three robots beside one another that do what they are told, all on one clock from 5 s on; the second has no poses
/// between 20 and 21 s, the third ends at 30 s, and stands from 10 s on.
Log threeRobots() {
    Log log;
    log.source = "made-up";
    log.format = "csv";
    for (const std::string name : {"a", "b", "c"}) {
        Trajectory t = obedientTrajectory(5 * second, (name == "c" ? 25 : 40) * second, [&](double time) {
            return name == "c" && time >= 5 ? Command{} : weaveAlong(time);
        });
        for (StampedPose& pose : t.poses) pose.pose.y += name == "a" ? 0 : name == "b" ? 5 : 10;
        if (name == "b")
            std::erase_if(t.poses, [](const StampedPose& p) { return p.time > 20 * second && p.time < 21 * second; });
        log.robots.push_back({name, {std::move(t)}, {}});
    }
    return log;
}

std::shared_ptr<const MotionModel> heldCommands(double gain = 1) {
    return std::make_shared<const HeldCommandModel>(100'000'000, gain);
}

Comparison comparedEvery(const Log& log, ScenarioParts parts, Nanoseconds every, Nanoseconds start = 0) {
    const auto world = LogWorld::create(std::move(parts), std::make_shared<const Log>(log));
    EXPECT_TRUE(world) << world.error().message();
    const auto requests = rolloutsOf(*world, {start, std::nullopt, every});
    EXPECT_TRUE(requests) << requests.error().message();
    const auto comparison = compare(*world, *requests);
    EXPECT_TRUE(comparison) << comparison.error().message();
    return *comparison;
}

TEST(Compare, RobotThatObeysIsWhereTheRealOneIs) {
    const Log log = threeRobots();
    const Comparison comparison = comparedEvery(log, playersOf(log, heldCommands()), 5 * second);
    ASSERT_EQ(comparison.requests.size(), 8u);
    ASSERT_EQ(comparison.rollouts.size(), 24u);
    for (const ComparedRollout& rollout : comparison.rollouts) {
        if (rollout.simulated.empty()) continue;
        const RobotLog& real = log.robots[rollout.real.robot];
        EXPECT_EQ(rollout.real.start, 5 * second + comparison.requests[rollout.request].start);
        EXPECT_EQ(rollout.simulated.size(), 50u);
        // The truth is a fit over 0.12 s, which cuts corners by less than that.
        for (std::size_t k = 0; k < 50; ++k)
            EXPECT_FALSE(rollout.errors.position[k] >= 3e-3) << real.robot << k;  // unknown ones are below
    }
}

TEST(Compare, SaysWhatIsLeftOutAndWhy) {
    const Log log = threeRobots();
    const Comparison comparison = comparedEvery(log, playersOf(log, heldCommands()), 5 * second);
    const auto uses = [&](std::size_t robot) { return comparison.summaries[robot].uses; };
    using Uses = std::array<std::size_t, rolloutUses>;  // counted, still, gap, absent
    EXPECT_EQ(uses(0), (Uses{8, 0, 0, 0}));
    EXPECT_EQ(uses(1), (Uses{7, 0, 1, 0})) << "without poses from 15 to 16 s of the clock";
    // It ends at 25 s: a rollout that starts there is measured from its last pose, but has no truth.
    EXPECT_EQ(uses(2), (Uses{1, 4, 1, 2})) << "it stands from 5 s on";
    EXPECT_EQ(comparison.all.rollouts(), 24u);
    EXPECT_EQ(comparison.all.of(RolloutUse::counted), 16u);
    EXPECT_EQ(comparison.counted.size(), 16u);
    EXPECT_EQ(comparison.log.windows.size(), 16u);
    for (const ComparedRollout& rollout : comparison.rollouts) {
        EXPECT_EQ(rollout.simulated.empty(), rollout.use == RolloutUse::absent);
        if (rollout.robot != 1 || rollout.use != RolloutUse::gap) continue;
        for (std::size_t k = 0; k < 50; ++k)  // after k + 1 steps
            EXPECT_EQ(std::isnan(rollout.errors.position[k]), k < 10) << k << ": the pose that ends it is in it";
        EXPECT_TRUE(std::isnan(rollout.errors.positionMean));
        EXPECT_FALSE(std::isnan(rollout.errors.positionFinal)) << "known again at the end";
    }
    EXPECT_EQ(comparison.summaries[1].positionFinal.count, 8u);
}

/// A single start of one robot that drives straight on and has no poses from `from` to `to`.
RolloutUse useWithGap(double from, double to, double start) {
    Log log = logOf({obedientTrajectory(0, 30 * second, straightOn)});
    std::erase_if(log.robots[0].trajectories[0].poses, [&](const StampedPose& pose) {
        return pose.time > fromSeconds(from) && pose.time < fromSeconds(to);
    });
    const auto world = LogWorld::create(playersOf(log, heldCommands()), std::make_shared<const Log>(log));
    EXPECT_TRUE(world) << world.error().message();
    const auto comparison = compare(*world, std::vector<RolloutRequest>{{0, fromSeconds(start), 100}});
    EXPECT_TRUE(comparison) << comparison.error().message();
    return comparison->rollouts.front().use;
}

TEST(Compare, GapsAreFoundWhereverTheyLie) {
    EXPECT_EQ(useWithGap(0, 0, 5), RolloutUse::counted);
    EXPECT_EQ(useWithGap(7.1, 7.25, 5), RolloutUse::counted) << "shorter than 0.2 s";
    // Between the instants over which paths are summed.
    EXPECT_EQ(useWithGap(7.11, 7.39, 5), RolloutUse::gap);
    // Just before the start, as the referee's windows are.
    EXPECT_EQ(useWithGap(4.6, 4.85, 5), RolloutUse::gap);
    EXPECT_EQ(useWithGap(4.4, 4.75, 5), RolloutUse::counted);
}

TEST(Compare, ErrorsAreThoseOfAGainThatIsWrong) {
    // A robot that drives straight on at 0.1 m/s, simulated at 1.1 times that: after t seconds 0.01 t m ahead.
    const Log log = logOf({obedientTrajectory(0, 30 * second, straightOn)});
    const Comparison comparison = comparedEvery(log, playersOf(log, heldCommands(1.1)), 10 * second, 2 * second);
    ASSERT_EQ(comparison.rollouts.size(), 2u);
    for (const ComparedRollout& rollout : comparison.rollouts) {
        EXPECT_NEAR(rollout.errors.positionFinal, 0.1, 1e-6);
        EXPECT_NEAR(rollout.errors.positionMean, 0.01 * (0.1 + 10) / 2, 1e-6);
        EXPECT_NEAR(rollout.errors.headingFinal, 0, 1e-9);
        EXPECT_NEAR(rollout.real.path, 1, 1e-6);
        EXPECT_FALSE(rollout.touched);
    }
    EXPECT_NEAR(comparison.all.counted.p, 5.05, 1e-4);
    EXPECT_EQ(comparison.summaries[0].counted.p, comparison.all.counted.p);
}

TEST(Compare, WorstRolloutIsFirst) {
    const Log log = threeRobots();
    auto models = std::vector{heldCommands(1), heldCommands(1.5), heldCommands(1)};
    const Comparison comparison = comparedEvery(log, playersOf(log, models), 10 * second);
    const auto worst = worstFirst(comparison);
    EXPECT_EQ(worst.size(), comparison.rollouts.size() - comparison.all.of(RolloutUse::absent));
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(comparison.rollouts[worst[i]].robot, 1u);
}

/// P, Hd and all other figures of the same windows.
void expectTheSameFigures(const Log& log, const std::vector<std::shared_ptr<const MotionModel>>& models) {
    const NamedModel named{"simulation", [&](const std::string& robot) -> const MotionModel* {
                               for (std::size_t i = 0; i < log.robots.size(); ++i)
                                   if (log.robots[i].robot == robot) return models[i].get();
                               return nullptr;
                           }};
    const auto evaluation = evaluate(log, {&named, 1}, {.relativeHorizons = {}, .withFloor = false});
    ASSERT_TRUE(evaluation) << evaluation.error().message();
    const auto world = LogWorld::create(playersOf(log, models), std::make_shared<const Log>(log));
    ASSERT_TRUE(world) << world.error().message();
    const auto comparison = compare(*world, rolloutsOfWindows(*world, evaluation->log.windows));
    ASSERT_TRUE(comparison) << comparison.error().message();
    ASSERT_EQ(comparison->touches, 0);
    EXPECT_EQ(comparison->all.of(RolloutUse::counted), evaluation->log.windows.size());
    const Evaluation ours{comparison->log, {comparison->simulation}};
    EXPECT_EQ(resultsCsv(ours), resultsCsv(*evaluation));
    EXPECT_EQ(windowsCsv(comparison->log), windowsCsv(evaluation->log));
    EXPECT_EQ(comparison->all.counted.p, evaluation->models[0].all.p);
    EXPECT_EQ(comparison->all.counted.hd, evaluation->models[0].all.hd);
    EXPECT_EQ(comparison->all.positionFinal.median, evaluation->models[0].all.positionFinal.median);
    for (const GroupSummary& group : evaluation->models[0].groups)
        for (std::size_t i = 0; i < comparison->robots.size(); ++i) {
            if (group.kind != "robot" || group.name != comparison->robots[i].realName) continue;
            EXPECT_EQ(comparison->summaries[i].counted.p, group.summary.p) << group.name;
        }
}

TEST(Compare, FiguresAreThoseOfTheEvaluation) {
    const Log log = shippedLog();
    expectTheSameFigures(log, learnedModels(log, "pioneer.net"));
}

TEST(Compare, FiguresOfRealLogsAreThoseOfTheEvaluation) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    const auto log = readLog(*data / "mrclam" / "MRCLAM_Dataset7");
    ASSERT_TRUE(log) << log.error().message();
    expectTheSameFigures(*log, learnedModels(*log, "create.net"));
}

/// Two robots that really drove through one another; simulated they cannot.
Log crossing() {
    Log log;
    log.source = "made-up";
    for (const double direction : {1.0, -1.0}) {
        Trajectory t = obedientTrajectory(0, 20 * second, [](double) { return Command{0.2, 0}; });
        const Pose before{-2 * direction, 0, direction > 0 ? 0 : std::acos(-1.0)};
        for (StampedPose& pose : t.poses) pose.pose = before * Pose{0.2 * toSeconds(pose.time), 0, 0};
        log.robots.push_back({direction > 0 ? "east" : "west", {std::move(t)}, {}});
    }
    return log;
}

TEST(Compare, ContactsOfTheSimulationAreCounted) {
    const Log log = crossing();
    const Comparison comparison = comparedEvery(log, playersOf(log, heldCommands()), 15 * second);
    ASSERT_EQ(comparison.rollouts.size(), 2u);
    EXPECT_GE(comparison.touches, 1);
    for (const ComparedRollout& rollout : comparison.rollouts) {
        EXPECT_EQ(rollout.touches, comparison.touches) << "each touched the other, and nothing else";
        // They begin 4 m apart and touch where their discs of 0.17 m meet, at 0.2 m/s each.
        ASSERT_TRUE(rollout.touched);
        EXPECT_NEAR(toSeconds(*rollout.touched), (4 - 2 * 0.17) / 0.4, 0.05);
        EXPECT_GT(rollout.errors.positionFinal, 0.5) << "the real ones drove on";
        const auto before = static_cast<std::size_t>(*rollout.touched / 100'000'000) - 1;
        EXPECT_LT(rollout.errors.position[before - 1], 1e-9);
    }
    EXPECT_EQ(comparison.all.touched, 2u);
}

TEST(Compare, RobotWithoutGroundTruthAtTheStartIsNotInTheWorld) {
    Log log = crossing();
    // Where "west" is is known only for the first 3 s: a rollout from 4 s on leaves it out, so that no robot is met.
    std::erase_if(log.robots[1].trajectories[0].poses, [](const StampedPose& pose) { return pose.time > 3 * second; });
    const Comparison comparison = comparedEvery(log, playersOf(log, heldCommands()), 15 * second, 4 * second);
    ASSERT_EQ(comparison.rollouts.size(), 2u);
    EXPECT_EQ(comparison.rollouts[0].use, RolloutUse::counted);
    EXPECT_EQ(comparison.rollouts[1].use, RolloutUse::absent);
    EXPECT_EQ(comparison.touches, 0);
    EXPECT_LT(comparison.rollouts[0].errors.positionFinal, 1e-9);
}

TEST(Compare, ThreadsDoNotMatter) {
    const Log log = threeRobots();
    const auto text = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const Comparison comparison = comparedEvery(log, playersOf(log, wearyModel()), 2 * second);
        return errorsCsv(comparison) + rolloutsCsv(comparison) + comparisonJson(comparison, {});
    };
    EXPECT_EQ(text(1), text(8));
}

TEST(Compare, TicksThatDoNotDivideTheStepAreRefused) {
    const Log log = threeRobots();
    ScenarioParts parts = playersOf(log, std::make_shared<const HeldCommandModel>(90'000'000));
    parts.scene.tickLength = 30'000'000;
    const auto world = LogWorld::create(std::move(parts), std::make_shared<const Log>(log));
    ASSERT_TRUE(world);
    const auto comparison = compare(*world, std::vector<RolloutRequest>{{0, 0, 10}});
    ASSERT_FALSE(comparison);
    EXPECT_EQ(comparison.error().message(),
              "tick_s: is 0.03; expected one that divides 0.1 s, the step of the comparison");
}

TEST(Compare, PeriodLongerThanTheStepIsComparedWithinItToo) {
    const Log log = logOf({obedientTrajectory(0, 30 * second, straightOn)});
    const auto slow = std::make_shared<const HeldCommandModel>(300'000'000, 1);
    const Comparison comparison = comparedEvery(log, playersOf(log, slow), 10 * second, 3 * second);
    for (const double error : comparison.rollouts.front().errors.position) EXPECT_LT(error, 1e-9);
}

}  // namespace
}  // namespace mrose
