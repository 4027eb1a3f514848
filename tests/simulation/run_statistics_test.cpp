#include "simulation/run_statistics.h"

#include <gtest/gtest.h>

#include "control/learned_mapping.h"
#include "simulation/small_world.h"

namespace mrose {
namespace {

/// Kicks once, at a time.
class KicksAt final : public Controller {
public:
    KicksAt(Nanoseconds time, bool fails) : time_(time), fails_(fails) {}
    void decide(const Observation& observation, std::span<std::byte> /*memory*/, Decision& decision) const override {
        decision.command = Command{};
        if (observation.time != time_) return;
        if (fails_)
            decision.fault = "lost its way";
        else
            decision.kicks.push_back({});
    }

private:
    Nanoseconds time_;
    bool fails_;
};

RunStatistics statisticsOf(const Scenario& scenario, int ticks, WorldState* last = nullptr) {
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    RunStatistics statistics(scenario, state);
    for (int i = 0; i < ticks; ++i) {
        step(scenario, state, buffers, {}, &trace);
        statistics.add(state, trace);
    }
    if (last != nullptr) *last = state;
    return statistics;
}

/// Says that it asks something learned beyond what it was learned of, for a second from 0.3 s on.
class AsksBeyond final : public Controller {
public:
    std::size_t memorySize() const override { return sizeof(double); }
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override {
        const double time = toSeconds(observation.time);
        as<double>(memory) = time >= 0.3 && time < 1.3 ? 0.2 : 0;
        decision.command = Command{};
    }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override {
        entries.add("something else", 1);
        entries.add(beyondLearned, as<double>(memory));
    }
};

TEST(RunStatistics, TellsForHowLongSomethingLearnedWasAskedBeyondWhatItKnows) {
    const Scenario scenario = SmallWorld()
                                  .robot(discRobot(), {}, std::make_shared<const AsksBeyond>(), ideal())
                                  .robot(discRobot(), {5, 5, 1}, std::make_shared<const Told>(Command{}), ideal())
                                  .scenario();
    WorldState state = scenario.initialState();
    RunStatistics statistics(scenario, state, true, true), uncounted(scenario, state);
    StepBuffers buffers;
    StepTrace trace;
    for (int i = 0; i < 100; ++i) {
        step(scenario, state, buffers, {}, &trace);
        statistics.add(state, trace);
        uncounted.add(state, trace);
    }
    ASSERT_EQ(statistics.beyond.size(), 2u);
    ASSERT_TRUE(statistics.beyond[0]);
    EXPECT_NEAR(statistics.shareOf(*statistics.beyond[0]), 0.5, 0.05) << "by whole control periods";
    EXPECT_EQ(statistics.beyond[1], std::nullopt);
    EXPECT_EQ(uncounted.beyond[0], std::nullopt);
}

TEST(RunStatistics, WaysAddUpToAndFro) {
    const std::vector<StampedCommand> toAndFro{{0, {0.5, 0}}, {2'000'000'000, {-0.5, 0}}};
    const Scenario scenario = SmallWorld()
                                  .robot(discRobot(), {}, std::make_shared<const Told>(Command{0.5, 0}), ideal())
                                  .robot(discRobot(), {5, 5, 1}, std::make_shared<const Told>(Command{0.5, 1}), ideal())
                                  .robot(discRobot(), {-5, 5, 1}, std::make_shared<const Told>(toAndFro), ideal())
                                  .robot(discRobot(), {-5, -5, 1}, std::make_shared<const Told>(Command{0, 1}), ideal())
                                  .scenario();
    const RunStatistics statistics = statisticsOf(scenario, 150);
    EXPECT_EQ(statistics.ticks, 150);
    ASSERT_EQ(statistics.driven.size(), 4u);
    EXPECT_NEAR(statistics.driven[0], 1.5, 1e-9);
    EXPECT_NEAR(statistics.driven[1], 1.5, 0.001) << "chords of a circle";
    EXPECT_NEAR(statistics.driven[2], 1.5, 0.03) << "a little more where it turns back";
    EXPECT_EQ(statistics.driven[3], 0);
    EXPECT_EQ(statistics.touches + statistics.kicks + statistics.faults, 0);
    EXPECT_EQ(statistics.firstFault, "");
}

/// By what step() tells: several points of one pair, in either order, are one touch for as long as it lasts.
TEST(RunStatistics, TouchCountsWhenItBegins) {
    const Scenario scenario = SmallWorld()
                                  .robot(discRobot(), {}, std::make_shared<const Told>(Command{}), ideal())
                                  .robot(discRobot(), {2, 0, 0}, std::make_shared<const Told>(Command{}), ideal())
                                  .object(ballType(), {4, 0, 0})
                                  .scenario();
    const WorldState state = scenario.initialState();
    RunStatistics statistics(scenario, state);
    using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
    const std::pair<Pairs, std::int64_t> ticks[] = {
        {{}, 0},
        {{{0, 1}, {0, 1}}, 1},
        {{{1, 0}}, 1},
        {{{0, 1}, {2, noBody}}, 2},
        {{{2, noBody}, {2, 1}}, 3},
        {{}, 3},
        {{{0, 1}, {1, 2}, {noBody, 2}, {0, noBody}}, 4},  // the others have not been apart for long
    };
    for (const auto& [pairs, touches] : ticks) {
        StepTrace trace;
        for (const auto& [a, b] : pairs) trace.contacts.push_back({a, b, 0, {}, {}, 1});
        statistics.add(state, trace);
        EXPECT_EQ(statistics.touches, touches);
    }
}

TEST(RunStatistics, TouchOfTheWorldIsCounted) {
    const Scenario scenario = SmallWorld()
                                  .robot(discRobot(0.2), {}, std::make_shared<const Told>(Command{0.4, 0}), ideal())
                                  .object(boxType(0.4, 5000), {0.8, 0, 0})
                                  .scenario();
    EXPECT_EQ(statisticsOf(scenario, 45).touches, 0) << "a gap of 0.4 m takes a second";
    EXPECT_GE(statisticsOf(scenario, 55).touches, 1);
}

TEST(RunStatistics, KicksHitOrMiss) {
    RobotType kicking = discRobot(0.2);
    kicking.manipulators.push_back({.name = "kicker", .position = {0.2, 0}, .width = 0.2});
    const auto world = [&](double ball) {
        return SmallWorld()
            .robot(kicking, {}, std::make_shared<const KicksAt>(1'000'000'000, false), ideal())
            .object(ballType(), {ball, 0, 0})
            .scenario();
    };
    const RunStatistics hit = statisticsOf(world(0.33), 100), miss = statisticsOf(world(1), 100);
    EXPECT_EQ(hit.kicks, 1);
    EXPECT_EQ(hit.hits, 1);
    EXPECT_EQ(miss.kicks, 1);
    EXPECT_EQ(miss.hits, 0);
}

/// It rolls out by v = v0 - a t, and lies still from v = 1 cm/s on, v0^2 / (2 a) from where it was; a box is no ball.
TEST(RunStatistics, BallThatRollsOutLiesStillForTheRest) {
    ObjectType ball = ballType();
    Environment floor;
    floor.floor.rollingDeceleration = 0.25;
    const auto world = [&](double speed) {
        SmallWorld rolling(floor);
        rolling.object(boxType(), {0, 5, 0}).object(ball, {0, 0, 0}, {speed, 0, 0}).object(ball, {0, -5, 0});
        rolling.robot(discRobot(), {-5, 0, 0}, std::make_shared<const Told>(Command{}), ideal());
        return rolling.scenario();
    };
    for (const double speed : {0.0, 0.3, 1.0, 2.5}) {
        // It begins to roll without slipping: only so has it the deceleration of a rolling ball from the start.
        const Scenario scenario = world(speed);
        WorldState state = scenario.initialState();
        state.objects[1].roll_W = {speed, 0};
        StepBuffers buffers;
        StepTrace trace;
        RunStatistics statistics(scenario, state);
        for (int i = 0; i < 1000; ++i) {
            step(scenario, state, buffers, {}, &trace);
            statistics.add(state, trace);
        }
        const double rolls = std::max(0.0, (speed - 0.01) / 0.25);
        EXPECT_NEAR(toSeconds(statistics.ballStill), 20 - rolls, 0.02 + 1e-9) << speed;
        EXPECT_NEAR(state.objects[1].pose.x, speed * speed / (2 * 0.25), 1e-3) << speed;
    }
}

TEST(RunStatistics, WithoutABallNoneLiesStill) {
    const Scenario scenario = SmallWorld().object(boxType(), {0, 5, 0}).scenario();
    EXPECT_EQ(statisticsOf(scenario, 50).ballStill, 0);
}

/// A ball rolls into the goal, lies at its start again, and rests there.
TEST(RunStatistics, GoalsAreCountedByGoal) {
    Environment field = walledField(6, 4);
    field.goals.push_back({"west", {{0, 1}, {0.5, 1}, {0.5, 3}, {0, 3}}});
    field.goals.push_back({"east", {{5.5, 1}, {6, 1}, {6, 3}, {5.5, 3}}});
    SmallWorld world(std::move(field));
    world.robot(discRobot(), {1, 0.5, 0}, std::make_shared<const Told>(Command{}), ideal())
        .object(ballType(), {4.5, 2, 0}, {2, 0, 0});
    for (const bool kickOff : {true, false}) {
        world.parts().kickOff = kickOff;
        const RunStatistics statistics = statisticsOf(world.scenario(), 500);
        EXPECT_EQ(statistics.goals, (std::vector<std::int32_t>{0, 1})) << kickOff;
    }
}

TEST(RunStatistics, FaultsAreCountedAndTheFirstIsNamed) {
    const Scenario scenario =
        SmallWorld()
            .robot(discRobot(), {}, std::make_shared<const Told>(Command{}), ideal())
            .robot(discRobot(), {2, 0, 0}, std::make_shared<const KicksAt>(1'000'000'000, true), ideal())
            .robot(discRobot(), {4, 0, 0}, std::make_shared<const KicksAt>(2'000'000'000, true), ideal())
            .scenario();
    EXPECT_EQ(statisticsOf(scenario, 49).faults, 0);
    const RunStatistics statistics = statisticsOf(scenario, 200);
    EXPECT_EQ(statistics.faults, 2);
    EXPECT_TRUE(statistics.firstFault.starts_with("robot 2 (2): ")) << statistics.firstFault;
    EXPECT_NE(statistics.firstFault.find("lost its way"), std::string::npos) << statistics.firstFault;
}

TEST(RunStatistics, PeopleAreCountedByThemselves) {
    RobotType human = discRobot();
    human.person = true;
    SmallWorld world;
    world.robot(discRobot(), {}, std::make_shared<const Told>(Command{}), ideal())
        .robot(discRobot(), {2, 0, 0}, std::make_shared<const Told>(Command{}), ideal())
        .robot(human, {4, 0, 0}, std::make_shared<const Told>(Command{}), ideal())
        .object(ballType(), {6, 0, 0});
    world.parts().scene.robots[2].name = "Anna";
    const Scene& scene = world.parts().scene;
    EXPECT_EQ(bodyName(scene, 1), "robot 2 (2)");
    EXPECT_EQ(bodyName(scene, 2), "person 1 (Anna)");
    EXPECT_EQ(bodyName(scene, 3), "ball0");
}

}  // namespace
}  // namespace mrose
