#include "behaviour/command_player.h"

#include <gtest/gtest.h>

#include "assessment/rollout.h"
#include "logs/log_reader.h"
#include "motion/learned_model.h"
#include "simulation/small_world.h"
#include "support/observation_parts.h"
#include "support/places.h"
#include "support/test_data.h"
#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

std::vector<StampedCommand> decided(const CommandPlayer& player, std::span<std::byte> memory, Nanoseconds now) {
    Decision decision;
    ObservationParts observation;
    observation.time = now;
    player.decide(observation, memory, decision);
    EXPECT_FALSE(decision.command);
    return decision.earlier;
}

TEST(CommandPlayer, IssuesEachCommandOnceWithItsOwnTime) {
    const std::vector<StampedCommand> commands{
        {-250 * ms, {0.1, 0}}, {-10 * ms, {0.2, 0}}, {37 * ms, {0.3, 1}}, {100 * ms, {0, 0}}, {101 * ms, {0.4, 0}}};
    const CommandPlayer player(commands);
    std::vector<std::byte> memory(player.memorySize());
    const auto part = [&](std::size_t from, std::size_t to) {
        return std::vector<StampedCommand>(commands.begin() + static_cast<std::ptrdiff_t>(from),
                                           commands.begin() + static_cast<std::ptrdiff_t>(to));
    };
    EXPECT_EQ(decided(player, memory, 0), part(0, 2));
    EXPECT_EQ(decided(player, memory, 100 * ms), part(2, 4));
    EXPECT_EQ(decided(player, memory, 200 * ms), part(4, 5));
    EXPECT_TRUE(decided(player, memory, 300 * ms).empty());
}

TEST(CommandPlayer, LeavesOutCommandsThatRepeatTheOneInForce) {
    const CommandPlayer player({{0, {0.1, 0}}, {10 * ms, {0.1, 0}}, {20 * ms, {0.1, -0.0}}, {30 * ms, {0.1, -0.0}}});
    std::vector<std::byte> memory(player.memorySize());
    EXPECT_EQ(decided(player, memory, 100 * ms), (std::vector<StampedCommand>{{0, {0.1, 0}}, {20 * ms, {0.1, -0.0}}}));
}

TEST(CommandPlayer, TellsCommandsPerPeriodFromTheBusiestOne) {
    EXPECT_EQ(CommandPlayer({}).commandsPerPeriod(100 * ms), 1u);
    std::vector<StampedCommand> commands;
    for (int i = 0; i < 20; ++i) commands.push_back({i * 100 * ms, {0.1 * i, 0}});
    for (int i = 0; i < 7; ++i) commands.push_back({3000 * ms + i * 15 * ms, {0, 0.1 * i + 0.1}});
    const CommandPlayer player(commands);
    EXPECT_EQ(player.commandsPerPeriod(100 * ms), 7u);  // 0, 15 ... 90 ms
    EXPECT_EQ(player.commandsPerPeriod(90 * ms), 6u);
    EXPECT_EQ(player.commandsPerPeriod(10 * ms), 1u);
    EXPECT_EQ(player.commandsPerPeriod(1000 * ms), 10u);
}

Scenario played(const std::vector<StampedCommand>& commands, std::shared_ptr<const MotionModel> model) {
    return SmallWorld()
        .robot(discRobot(), {}, std::make_shared<const CommandPlayer>(commands), std::move(model))
        .scenario();
}

/// Poses at the ends of the control periods.
std::vector<Pose> driven(const Scenario& scenario, WorldState& state, int periods) {
    std::vector<Pose> poses;
    for (int i = 0; i < periods; ++i) {
        run(scenario, state, static_cast<int>(scenario.periodOf(0).ticks));
        poses.push_back(state.robots[0].pose);
    }
    return poses;
}

void expectSame(const std::vector<Pose>& world, const std::vector<Pose>& rollout) {
    ASSERT_EQ(world.size(), rollout.size());
    for (std::size_t i = 0; i < world.size(); ++i) {
        ASSERT_NEAR(world[i].x, rollout[i].x, 1e-12) << "period " << i;
        ASSERT_NEAR(world[i].y, rollout[i].y, 1e-12) << "period " << i;
        ASSERT_NEAR(world[i].heading, rollout[i].heading, 1e-12) << "period " << i;
    }
}

std::vector<StampedCommand> shifted(std::vector<StampedCommand> commands, Nanoseconds by) {
    for (StampedCommand& command : commands) command.time += by;
    return commands;
}

/// Bursts and pauses, at instants that are multiples of nothing.
Trajectory burstyLog() {
    Trajectory log;
    Nanoseconds time = -2'345'678'901;
    for (int i = 0; i < 200; ++i) {
        const NoisePair u = uniformPair({51, i, 0, 0}), c = uniformPair({51, i, 1, 0});
        time += static_cast<Nanoseconds>((i % 20 < 8 ? 12e6 : 150e6) * u.first) + 1;
        log.commands.push_back({time, {c.first - 0.3, 2 * c.second - 1}});
    }
    return log;
}

TEST(CommandPlayer, LogDrivenThroughTheWorldIsTheModelsRollout) {
    KinematicParameters parameters;
    parameters.v = {.deadTime = 0.237, .lag = 0.15, .gain = 0.9, .acceleration = 1};
    parameters.w = {.deadTime = 0.411, .lag = 0.1};
    const auto model = std::make_shared<const KinematicModel>(parameters);
    const Trajectory log = burstyLog();
    const auto expected = rollOut(*model, std::vector<RolloutStart>{{&log, 0, {}, StampedVelocity{}, 80}});
    ASSERT_TRUE(expected);
    const Scenario scenario = played(log.commands, model);
    WorldState state = scenario.initialState();
    expectSame(driven(scenario, state, 80), (*expected)[0]);
}

/// The prediction of `mrose predict` begins with the velocity that the model reaches from standstill over the lead; so
/// does the world here.
void expectPrediction(const Trajectory& log, Nanoseconds start, const std::shared_ptr<const MotionModel>& model) {
    const RolloutOptions options;
    const int periods = 100;
    const auto expected = rollOut(*model, std::vector<RolloutStart>{{&log, start, {}, std::nullopt, periods}});
    ASSERT_TRUE(expected);
    const Scenario lead = played(shifted(log.commands, options.lead - start), model);
    WorldState before = lead.initialState();
    driven(lead, before, static_cast<int>(options.lead / model->period()));
    const Scenario scenario = played(shifted(log.commands, -start), model);
    WorldState state = scenario.initialState();
    state.robots[0].velocity_B = before.robots[0].velocity_B;
    const std::vector<Pose> poses = driven(scenario, state, periods);
    expectSame(poses, (*expected)[0]);
    EXPECT_GT(length(position(poses.back())), 0.05);
}

TEST(CommandPlayer, RealLogsDrivenThroughTheWorldAreThePrediction) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    const auto log = readLog(*data / "mrclam" / "MRCLAM_Dataset6");
    ASSERT_TRUE(log) << log.error().message();
    const auto network = loadNetwork(sourceFolder() / "nets" / "create.net");
    ASSERT_TRUE(network) << network.error().message();
    const auto motion = std::make_shared<const LearnedMotion>(*network);
    int driven = 0;
    for (const RobotLog& robot : log->robots)
        for (const double after : {20.0, 97.3, 400.05}) {
            const Trajectory& trajectory = robot.trajectories.front();
            const Nanoseconds start = trajectory.commands.front().time + fromSeconds(after);
            expectPrediction(trajectory, start, std::make_shared<const LearnedModel>(motion, robot.robot));
            ++driven;
        }
    EXPECT_EQ(driven, 15);
}

}  // namespace
}  // namespace mrose
