// Where nothing touches, a log that drives the world's steps gives what the log's open-loop prediction gives, to the
// bit.
#include <gtest/gtest.h>

#include "assessment/played_scenarios.h"
#include "assessment/test_models.h"
#include "assessment/tracker_history.h"
#include "logs/log_reader.h"
#include "simulation/step.h"
#include "support/places.h"
#include "support/test_data.h"
#include "support/units.h"

namespace mrose {
namespace {

using Models = std::vector<std::shared_ptr<const MotionModel>>;

struct Equality {
    std::size_t rollouts = 0, poses = 0, touched = 0;
};

/// Each rollout up to the instant at which contact takes its robot off its way.
Equality expectEqual(const Log& log, const Models& models, const Comparison& comparison) {
    Equality equality;
    TrackerHistories histories;
    const Nanoseconds step = RolloutOptions{}.step;
    for (const ComparedRollout& rollout : comparison.rollouts) {
        if (rollout.use == RolloutUse::absent) continue;
        const Trajectory& trajectory = log.robots[rollout.real.robot].trajectories[rollout.real.trajectory];
        auto start = measureStart(trajectory, rollout.real.start, static_cast<int>(rollout.simulated.size()));
        EXPECT_TRUE(start);
        if (start) start->tracked = histories.of(trajectory, *models[rollout.real.robot]).at(start->time);
        const auto predicted = rollOut(*models[rollout.real.robot], {&*start, 1});
        EXPECT_TRUE(predicted) << predicted.error().message();
        if (!start || !predicted) continue;
        const auto free =
            rollout.touched ? static_cast<std::size_t>((*rollout.touched - 1) / step) : rollout.simulated.size();
        for (std::size_t k = 0; k < free; ++k) {
            EXPECT_EQ(rollout.simulated[k], predicted->front()[k])
                << "robot " << log.robots[rollout.real.robot].robot << " from " << rollout.real.start << ", step " << k;
            if (rollout.simulated[k] != predicted->front()[k]) return equality;
            ++equality.poses;
        }
        equality.touched += rollout.touched ? 1 : 0;
        ++equality.rollouts;
    }
    return equality;
}

Comparison compared(const Log& log, const Models& models, const std::vector<Window>& windows) {
    const auto world = LogWorld::create(playersOf(log, models), std::make_shared<const Log>(log));
    EXPECT_TRUE(world) << world.error().message();
    const auto comparison = compare(*world, rolloutsOfWindows(*world, windows));
    EXPECT_TRUE(comparison) << comparison.error().message();
    return *comparison;
}

Models modelsOf(const std::string& what, const Log& log) {
    return what == "kinematic" ? Models(log.robots.size(), wearyModel()) : learnedModels(log, what);
}

class SameAsPrediction : public testing::TestWithParam<std::string> {};

TEST_P(SameAsPrediction, OnTheLogThatShips) {
    const Log log = shippedLog();
    const Models models = modelsOf(GetParam(), log);
    const auto windows = findWindows(log);
    ASSERT_TRUE(windows) << windows.error().message();
    const Equality equality = expectEqual(log, models, compared(log, models, *windows));
    EXPECT_EQ(equality.rollouts, windows->size());
    EXPECT_EQ(equality.touched, 0u);
    EXPECT_GT(equality.poses, 2000u);
}

/// Logs of several robots on one clock, which start between the ticks and periods of whatever runs.
TEST_P(SameAsPrediction, OnRealLogs) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    for (const int dataset : {6, 7}) {
        const auto folder = *data / "mrclam" / ("MRCLAM_Dataset" + std::to_string(dataset));
        if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no " << folder;
        const auto log = readLog(folder);
        ASSERT_TRUE(log) << log.error().message();
        const Models models = modelsOf(GetParam(), *log);
        const auto windows = findWindows(*log);
        ASSERT_TRUE(windows) << windows.error().message();
        const Equality equality = expectEqual(*log, models, compared(*log, models, *windows));
        EXPECT_EQ(equality.rollouts, windows->size());
        EXPECT_LT(equality.touched, windows->size() / 20);
        EXPECT_GT(equality.poses, 95 * windows->size());
    }
}

TEST_P(SameAsPrediction, FromAnyNanosecondWithAllRobotsAtOnce) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    const auto log = readLog(*data / "mrclam" / "MRCLAM_Dataset6");
    ASSERT_TRUE(log) << log.error().message();
    const Models models = modelsOf(GetParam(), *log);
    const auto world = LogWorld::create(playersOf(*log, models), std::make_shared<const Log>(*log));
    ASSERT_TRUE(world) << world.error().message();
    std::vector<RolloutRequest> requests;
    for (Nanoseconds i = 0; i < 12; ++i) requests.push_back({0, i * 71'234'567'891, 60});
    const auto comparison = compare(*world, requests);
    ASSERT_TRUE(comparison) << comparison.error().message();
    EXPECT_GT(expectEqual(*log, models, *comparison).rollouts, 50u);
}

INSTANTIATE_TEST_SUITE_P(Models, SameAsPrediction,
                         testing::Values("create.net", "create_paper.net", "pioneer.net", "kinematic"),
                         [](const auto& test) { return test.param.substr(0, test.param.find('.')); });

/// A drive that ramps, which the log's commands catch anywhere on its way.
TEST(SameAsPrediction, OfADriveThatRamps) {
    auto network = loadNetwork(sourceFolder() / "nets" / "pioneer.net");
    ASSERT_TRUE(network) << network.error().message();
    network->limits = {0.3, 3, 0.5, 0.18, 0.5};
    const Models models{
        std::make_shared<const LearnedModel>(std::make_shared<const LearnedMotion>(std::move(*network)), "any")};
    const Log log = logOf({obedientTrajectory(0, 12 * second, [](double t) {
        return Command{std::fmod(t, 1.7) < 0.8 ? 0.5 : -0.1, std::sin(7 * t)};
    })});
    const auto world = LogWorld::create(playersOf(log, models), std::make_shared<const Log>(log));
    ASSERT_TRUE(world) << world.error().message();
    std::vector<RolloutRequest> requests;
    for (Nanoseconds i = 0; i < 12; ++i) requests.push_back({0, 3 * second + i * 271'828'182, 40});
    const auto comparison = compare(*world, requests);
    ASSERT_TRUE(comparison) << comparison.error().message();
    EXPECT_EQ(expectEqual(log, models, *comparison).rollouts, requests.size());
}

TEST(SameAsPrediction, WhereTheStartsVelocityIsUnknownAndWhereTheCommandWasLongInForce) {
    // At its first pose a log tells no velocity; a steady trajectory had its first command before it began.
    Trajectory trajectory = obedientTrajectory(0, 9 * second, [](double t) { return Command{0.2, 0.1 * t}; });
    for (const bool steady : {false, true}) {
        trajectory.steady = steady;
        const Log log = logOf({trajectory});
        const Models models{wearyModel()};
        const auto world = LogWorld::create(playersOf(log, models), std::make_shared<const Log>(log));
        ASSERT_TRUE(world) << world.error().message();
        const auto comparison = compare(*world, std::vector<RolloutRequest>{{0, 0, 50}, {0, 50'000'001, 50}});
        ASSERT_TRUE(comparison) << comparison.error().message();
        EXPECT_FALSE(comparison->rollouts[0].real.measuredVelocity);
        EXPECT_EQ(expectEqual(log, models, *comparison).rollouts, 2u);
        EXPECT_EQ(comparison->rollouts[0].simulated[0] != trajectory.poses[0].pose, steady) << "dead time";
    }
}

/// A sample of a prediction is the run with its seed.
TEST(SameAsPrediction, OfARunWithItsNoiseForAnySeed) {
    const Log log = shippedLog();
    auto network = loadNetwork(sourceFolder() / "nets" / "create.net");
    ASSERT_TRUE(network) << network.error().message();
    ASSERT_TRUE(network->noise);
    const auto motion = std::make_shared<const LearnedMotion>(std::move(*network));
    const Models models{std::make_shared<const LearnedModel>(motion, "any", MotionDraw::noisy)};
    const auto world = LogWorld::create(playersOf(log, models), std::make_shared<const Log>(log));
    ASSERT_TRUE(world) << world.error().message();
    constexpr int steps = 60;
    std::vector<std::vector<Pose>> runs;
    for (const std::uint64_t seed : {0u, 7u}) {
        const LogWorld::Opened opened = world->openAt(0, 2 * second, steps * 100 * ms, seed);
        ASSERT_TRUE(opened.starts[0]);
        RolloutStart start = *opened.starts[0];
        start.steps = steps;
        start.seed = seed;
        const auto predicted = rollOut(*models[0], {&start, 1});
        ASSERT_TRUE(predicted) << predicted.error().message();
        WorldState state = opened.state;
        StepBuffers buffers;
        std::vector<Pose> poses;
        for (int tick = 1; tick <= 5 * steps; ++tick) {
            step(*opened.scenario, state, buffers);
            if (tick % 5 == 0) poses.push_back(state.robots[0].pose);
        }
        EXPECT_EQ(poses, predicted->front());
        runs.push_back(poses);
    }
    EXPECT_NE(runs[0], runs[1]);
}

}  // namespace
}  // namespace mrose
