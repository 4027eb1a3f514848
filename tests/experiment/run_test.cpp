#include "experiment/run.h"

#include <gtest/gtest.h>

#include "experiment/trial_world.h"
#include "simulation/small_world.h"
#include "support/units.h"
#include "world/state_difference.h"

namespace mrose {
namespace {

/// Fails, or decides otherwise each time it is asked, from a time on.
class Misbehaving final : public Controller {
public:
    Misbehaving(Nanoseconds from, bool hides) : from_(from), hides_(hides) {}
    void decide(const Observation& observation, std::span<std::byte> /*memory*/, Decision& decision) const override {
        decision.command = Command{0.1, 0};
        if (observation.time < from_) return;
        if (hides_)
            decision.command->v = 0.001 * ++asked_;
        else
            decision.fault = "gave up";
    }

private:
    Nanoseconds from_;
    bool hides_;
    mutable int asked_ = 0;
};

Scenario misbehaving(Nanoseconds from, bool hides) {
    return SmallWorld().robot(discRobot(), {}, std::make_shared<const Misbehaving>(from, hides), ideal()).scenario();
}

TEST(Run, LastsForTheDurationInWholeTicks) {
    const Scenario scenario(trialWorld());
    const std::pair<Nanoseconds, std::int64_t> cases[] = {
        {second, 50}, {second + 1, 51}, {second - 1, 50}, {ms, 1}, {0, 0}};
    for (const auto& [duration, ticks] : cases) {
        const auto result = run(scenario, scenario.initialState(), {.duration = duration});
        ASSERT_TRUE(result);
        EXPECT_EQ(result->end, RunEnd::duration);
        EXPECT_EQ(result->state.tick, ticks) << duration;
        EXPECT_EQ(result->statistics.ticks, ticks);
    }
    EXPECT_STREQ(name(RunEnd::duration), "duration");
}

TEST(Run, StepsAsStepDoes) {
    const Scenario scenario(trialWorld());
    WorldState state = scenario.initialState();
    run(scenario, state, 200);
    for (const bool checked : {false, true}) {
        const auto result = run(scenario, scenario.initialState(), {.duration = 4 * second, .checkRewind = checked});
        ASSERT_TRUE(result);
        EXPECT_EQ(result->end, RunEnd::duration);
        EXPECT_FALSE(firstDifference(result->state, state));
    }
}

/// From a state in the middle it goes on for the duration from there.
TEST(Run, BeginsWhereItIsTold) {
    const Scenario scenario(trialWorld());
    const auto half = run(scenario, scenario.initialState(), {.duration = second});
    ASSERT_TRUE(half);
    const auto rest = run(scenario, half->state, {.duration = 2 * second});
    const auto whole = run(scenario, scenario.initialState(), {.duration = 3 * second});
    ASSERT_TRUE(rest && whole);
    EXPECT_EQ(rest->state.tick, 150);
    EXPECT_EQ(rest->statistics.ticks, 100);
    EXPECT_FALSE(firstDifference(rest->state, whole->state));
}

TEST(Run, EndsAfterTheFirstTickAtWhichTheConditionHolds) {
    const Scenario scenario(trialWorld());
    auto condition = compileCondition("time > 0.705", scenario);
    ASSERT_TRUE(condition) << condition.error().message();
    const auto result = run(scenario, scenario.initialState(), {.duration = 3 * second, .until = &*condition});
    ASSERT_TRUE(result);
    EXPECT_EQ(result->end, RunEnd::condition);
    EXPECT_STREQ(name(result->end), "condition");
    EXPECT_EQ(result->state.tick, 36);
    auto never = compileCondition("time > 7", scenario);
    const auto whole = run(scenario, scenario.initialState(), {.duration = 3 * second, .until = &*never});
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->end, RunEnd::duration);
}

TEST(Run, ConditionThatCannotBeAnsweredIsAnError) {
    const Scenario scenario(trialWorld());
    auto condition = compileCondition("(function() if time > 1 then return 7 end return false end)()", scenario);
    ASSERT_TRUE(condition) << condition.error().message();
    const auto result = run(scenario, scenario.initialState(), {.duration = 3 * second, .until = &*condition});
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message().find('7'), std::string::npos) << result.error().message();
}

TEST(Run, EndsOnAFaultIfItShall) {
    const Scenario scenario = misbehaving(600 * ms, false);
    const auto ends = run(scenario, scenario.initialState(), {.duration = 2 * second, .endOnFault = true});
    ASSERT_TRUE(ends);
    EXPECT_EQ(ends->end, RunEnd::fault);
    EXPECT_STREQ(name(ends->end), "fault");
    EXPECT_EQ(ends->state.tick, 31) << "after the tick that began at 0.6 s";
    const auto goesOn = run(scenario, scenario.initialState(), {.duration = 2 * second});
    ASSERT_TRUE(goesOn);
    EXPECT_EQ(goesOn->end, RunEnd::duration);
    EXPECT_GT(goesOn->statistics.faults, 0);
}

TEST(Run, EndsWhereATickCannotBeTakenBack) {
    const Scenario scenario = misbehaving(600 * ms, true);
    const auto ends = run(scenario, scenario.initialState(), {.duration = 2 * second, .checkRewind = true});
    ASSERT_TRUE(ends);
    EXPECT_EQ(ends->end, RunEnd::rewind);
    EXPECT_STREQ(name(ends->end), "rewind");
    EXPECT_EQ(ends->state.tick, 31);
    ASSERT_EQ(ends->hidden.size(), 1u);
    EXPECT_EQ(ends->hidden[0].robot, 0u);
    const auto unchecked = run(scenario, scenario.initialState(), {.duration = 2 * second});
    ASSERT_TRUE(unchecked);
    EXPECT_EQ(unchecked->end, RunEnd::duration);
}

TEST(Run, WatcherSeesEveryTickAndMayStopIt) {
    const Scenario scenario(trialWorld());
    std::vector<std::int64_t> ticks;
    RunOptions options;
    options.each = [&](const WorldState& state, const StepTrace& trace) {
        EXPECT_EQ(trace.robots.size(), 2u);
        ticks.push_back(state.tick);
        return state.tick < 20;
    };
    const auto result = run(scenario, scenario.initialState(), options);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->end, RunEnd::stopped);
    EXPECT_STREQ(name(result->end), "stopped");
    EXPECT_EQ(result->state.tick, 20);
    ASSERT_EQ(ticks.size(), 20u);
    for (std::size_t i = 0; i < ticks.size(); ++i) EXPECT_EQ(ticks[i], static_cast<std::int64_t>(i) + 1);
}

/// Annotates where it is wanted, and counts how often it was.
class Annotating final : public Controller {
public:
    void decide(const Observation& /*observation*/, std::span<std::byte> /*memory*/,
                Decision& decision) const override {
        decision.command = Command{0.1, 0.2};
        if (!decision.wantsAnnotations) return;
        ++wanted;
        decision.annotations.push_back({.label = "wanted", .value = 1});
    }
    mutable int wanted = 0;
};

TEST(Run, NothingIsAnnotatedWhereNobodyWatches) {
    const auto controller = std::make_shared<const Annotating>();
    const Scenario scenario = SmallWorld().robot(discRobot(), {}, controller, ideal()).scenario();
    const RunOptions unwatched{.duration = second};
    const auto alone = run(scenario, scenario.initialState(), unwatched);
    ASSERT_TRUE(alone);
    EXPECT_EQ(controller->wanted, 0);
    RunOptions watched = unwatched;
    std::size_t annotations = 0;
    watched.each = [&](const WorldState&, const StepTrace& trace) {
        annotations += trace.robots[0].decision.annotations.size();
        return true;
    };
    const auto seen = run(scenario, scenario.initialState(), watched);
    ASSERT_TRUE(seen);
    EXPECT_GT(annotations, 5u);
    EXPECT_EQ(controller->wanted, static_cast<int>(annotations));
    EXPECT_FALSE(firstDifference(alone->state, seen->state));
    auto noted = compileCondition("robot[1].note.wanted == 1", scenario);
    ASSERT_TRUE(noted) << noted.error().message();
    RunOptions asking = unwatched;
    asking.until = &*noted;
    const auto asked = run(scenario, scenario.initialState(), asking);
    ASSERT_TRUE(asked);
    EXPECT_EQ(asked->end, RunEnd::condition);
}

TEST(Run, GoesOnAsLongAsItIsToldTo) {
    const Scenario scenario(trialWorld());
    RunOptions options;
    options.goesOn = [](const WorldState& state) { return state.tick < 7; };
    const auto result = run(scenario, scenario.initialState(), options);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->end, RunEnd::stopped);
    EXPECT_EQ(result->state.tick, 7);
}

}  // namespace
}  // namespace mrose
