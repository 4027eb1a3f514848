#include "recording/replay.h"

#include <gtest/gtest.h>

#include "recording/recording_fixture.h"
#include "world/state_difference.h"

namespace mrose {
namespace {

/// Decides as Rover, but remembers one more than it does from `from` on.
class Forgetful final : public Controller {
public:
    explicit Forgetful(Nanoseconds from) : from_(from) {}
    std::size_t memorySize() const override { return rover_.memorySize() + 16; }
    std::size_t commandsPerPeriod(Nanoseconds period) const override { return rover_.commandsPerPeriod(period); }
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override {
        rover_.decide(observation, memory.first(rover_.memorySize()), decision);
        if (observation.robot == 5 && observation.time >= from_) memory[rover_.memorySize() + 3] = std::byte{9};
    }

private:
    Rover rover_;
    Nanoseconds from_;
};

/// Whatever it decides at one instant cannot be obeyed.
class Faulty final : public Controller {
public:
    std::size_t memorySize() const override { return rover_.memorySize(); }
    std::size_t commandsPerPeriod(Nanoseconds period) const override { return rover_.commandsPerPeriod(period); }
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override {
        rover_.decide(observation, memory, decision);
        if (observation.robot == 1) decision.command = Command{std::nan("7"), 0};
        if (observation.robot == 2) decision.fault = "its plug-in threw";
        if (observation.robot == 3) decision.kicks.push_back({17, 1});
        if (observation.robot == 4) decision.command = Command{1e160, 0};
        if (observation.robot == 5) decision.command = Command{0, -1e200};
    }

private:
    Rover rover_;
};

/// Stands, and turns at a rate of zero with such a sign.
class Standing final : public Controller {
public:
    explicit Standing(double zero) : zero_(zero) {}
    void decide(const Observation& /*observation*/, std::span<std::byte> /*memory*/,
                Decision& decision) const override {
        decision.command = Command{0, zero_};
    }

private:
    double zero_;
};

std::vector<Branch> recorded(const StraightRun& run, std::int64_t keyframeInterval) {
    History::Options options;
    options.keyframeInterval = keyframeInterval;
    History history(run.states.front(), options);
    for (std::size_t i = 0; i < run.traces.size(); ++i) history.add(run.states[i + 1], run.traces[i]);
    return history.branches();
}

std::vector<RobotDecision> hand(std::int64_t tick) {
    Decision decision;
    decision.command = Command{0.5, 1};
    decision.kicks.push_back({0, 1});
    return tick / 10 % 3 == 0 ? std::vector<RobotDecision>{{0, decision}, {6, {}}} : std::vector<RobotDecision>{};
}

class Replay : public testing::TestWithParam<bool> {
protected:
    ReplayOptions options() const { return {GetParam(), {}}; }
    Scenario scenario{matchParts()};
};

TEST_P(Replay, GivesTheSameOverContactsAndHands) {
    const StraightRun run = runMatch(scenario, scenario.initialState(), 2000, hand);
    const auto report = replay(recorded(run, 300), scenario, options());
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->difference) << report->difference->what;
    EXPECT_EQ(report->ticks, 2000);
    EXPECT_FALSE(report->cancelled);
}

TEST_P(Replay, GivesTheSameWhereControllersFail) {
    MatchOptions faulty;
    faulty.controller = std::make_shared<const Faulty>();
    const Scenario failing(matchParts(faulty));
    const StraightRun run = runMatch(failing, failing.initialState(), 200);
    std::size_t faults = 0;
    for (const StepTrace& trace : run.traces) faults += trace.faults.size();
    EXPECT_GT(faults, 50u);
    const auto report = replay(recorded(run, 60), failing, options());
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->difference) << report->difference->what;
}

TEST_P(Replay, NamesTheFirstTickAndFieldThatDiffer) {
    const StraightRun run = runMatch(scenario, scenario.initialState(), 100);
    ScenarioParts parts = matchParts();
    parts.scene.environment.floor.rollingDeceleration *= 1.5;
    const Scenario changed(std::move(parts));
    std::int64_t first = 0;
    const StraightRun other = runMatch(changed, changed.initialState(), 100);
    while (!firstDifference(run.states[static_cast<std::size_t>(first)], other.states[static_cast<std::size_t>(first)]))
        ++first;

    const auto report = replay(recorded(run, 1), changed, options());
    ASSERT_TRUE(report && report->difference);
    EXPECT_EQ(report->difference->tick, first);
    EXPECT_EQ(report->difference->branch, 0u);
    const ObjectState &then = run.states[static_cast<std::size_t>(first)].objects[0],
                      &now = other.states[static_cast<std::size_t>(first)].objects[0];
    ASSERT_NE(then.pose.x, now.pose.x);
    EXPECT_EQ(report->difference->what.find("object 1 (ball) pose.x: recorded "), 0u) << report->difference->what;
    EXPECT_EQ(report->ticks, first);

    const auto coarse = replay(recorded(run, 40), changed, options());
    EXPECT_EQ(coarse->difference->tick, first);
    EXPECT_EQ(coarse->difference->what.find("at tick 40, where the next state was kept, "), 0u);
    const auto none = replay(recorded(run, 1000), changed, options());
    EXPECT_NE(none->difference->what.find("no state was kept"), std::string::npos);
}

TEST_P(Replay, AnotherScenarioIsAnError) {
    const std::vector<Branch> branches = recorded(runMatch(scenario, scenario.initialState(), 10), 5);
    MatchOptions few;
    few.robots = 2;
    const auto report = replay(branches, Scenario(matchParts(few)), options());
    ASSERT_FALSE(report);
    EXPECT_NE(report.error().message().find("recorded of another scenario"), std::string::npos);
}

TEST_P(Replay, TellsItsProgressAndStopsWhenTold) {
    const std::vector<Branch> branches = recorded(runMatch(scenario, scenario.initialState(), 100), 20);
    ReplayOptions asked = options();
    std::vector<std::int64_t> done;
    asked.progress = [&](std::int64_t now, std::int64_t all) {
        EXPECT_EQ(all, 100);
        done.push_back(now);
        return now < 60;
    };
    const auto report = replay(branches, scenario, asked);
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->cancelled);
    EXPECT_EQ(report->ticks, 60);
    EXPECT_EQ(done, (std::vector<std::int64_t>{20, 40, 60}));
}

INSTANTIATE_TEST_SUITE_P(ByDecisionsAndByControllers, Replay, testing::Bool(),
                         [](const auto& instance) { return instance.param ? "Deciding" : "Obeying"; });

TEST(ReplayOfMemories, OtherDecisionsAreNamed) {
    const Scenario scenario(matchParts());
    const std::vector<Branch> branches = recorded(runMatch(scenario, scenario.initialState(), 150), 50);
    MatchOptions other;
    other.controller = std::make_shared<const Rover>(1, 1'000'000'000);
    const Scenario changed(matchParts(other));
    const auto obeying = replay(branches, changed, {false, {}});
    ASSERT_TRUE(obeying);
    EXPECT_FALSE(obeying->difference);

    const auto deciding = replay(branches, changed, {true, {}});
    ASSERT_TRUE(deciding && deciding->difference);
    // The first robot that decides with a command at or after 1 s, whose phase is 0, decides in tick 50.
    EXPECT_EQ(deciding->difference->tick, 51);
    EXPECT_NE(deciding->difference->what.find("the controller of robot 1 (rover 1) had ordered v "), std::string::npos)
        << deciding->difference->what;
    EXPECT_NE(deciding->difference->what.find("at tick 100, where the next state was kept, robot 1 (rover 1) pose.x"),
              std::string::npos)
        << deciding->difference->what;
}

TEST(ReplayOfMemories, SignOfAZeroIsAnotherDecision) {
    const auto scenarioWith = [](double zero) {
        MatchOptions options;
        options.robots = 1;
        options.controller = std::make_shared<const Standing>(zero);
        return Scenario(matchParts(options));
    };
    const Scenario scenario = scenarioWith(0.0), changed = scenarioWith(-0.0);
    const auto report = replay(recorded(runMatch(scenario, scenario.initialState(), 10), 5), changed, {true, {}});
    ASSERT_TRUE(report && report->difference);
    EXPECT_EQ(report->difference->tick, 1);
    EXPECT_EQ(
        report->difference->what.find("the controller of robot 1 (rover 1) had ordered v 0.0 w 0.0 and now orders "
                                      "v 0.0 w -0.0; "),
        0u)
        << report->difference->what;
}

TEST(ReplayOfMemories, HiddenMemoryIsNamed) {
    const auto scenarioWith = [](Nanoseconds from) {
        MatchOptions options;
        options.controller = std::make_shared<const Forgetful>(from);
        return Scenario(matchParts(options));
    };
    const Scenario scenario = scenarioWith(std::numeric_limits<Nanoseconds>::max()),
                   changed = scenarioWith(500'000'000);
    const std::vector<Branch> branches = recorded(runMatch(scenario, scenario.initialState(), 60), 40);
    EXPECT_FALSE(replay(branches, changed, {false, {}})->difference);
    const auto report = replay(branches, changed, {true, {}});
    ASSERT_TRUE(report && report->difference);
    EXPECT_EQ(report->difference->tick, 26);  // robot 6 decides in ticks 0, 5 ... 25
    EXPECT_EQ(report->difference->what,
              "what sensors or controllers remember differs; at tick 40, where the next state was kept, controller "
              "memory of robot 6 (rover 6), byte 19: recorded 0, now 9");
}

TEST_F(RecordingFile, ReplaysWithItsBranches) {
    const auto recording = openRecording(record());
    ASSERT_TRUE(recording);
    for (const bool decide : {false, true}) {
        const auto report = replay(recording->branches, scenario, {decide, {}});
        ASSERT_TRUE(report);
        EXPECT_FALSE(report->difference) << report->difference->what;
        EXPECT_EQ(report->ticks, ticks + branchTicks);
    }
}

/// Where a plug-in is not at hand, what the recording knows of it is enough to replay without deciding.
TEST_F(RecordingFile, ReplaysWithoutTheControllers) {
    const auto recording = openRecording(record());
    ASSERT_TRUE(recording);
    ScenarioParts parts = matchParts();
    for (std::size_t i = 0; i < parts.controllers.size(); ++i)
        parts.controllers[i] = std::make_shared<const RecordedController>(recording->header.controllers[i]);
    const Scenario without(std::move(parts));
    const auto report = replay(recording->branches, without, {});
    ASSERT_TRUE(report) << report.error().message();
    EXPECT_FALSE(report->difference) << report->difference->what;
}

}  // namespace
}  // namespace mrose
