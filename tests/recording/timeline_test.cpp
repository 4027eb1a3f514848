#include "recording/timeline.h"

#include <gtest/gtest.h>

#include "recording/history.h"
#include "recording/match.h"
#include "recording/playback.h"
#include "recording/tick_decisions.h"
#include "world/state_difference.h"

namespace mrose {
namespace {

Timeline timelineOf(const StraightRun& run, std::int64_t keyframeInterval) {
    Timeline timeline(run.states.front(), keyframeInterval);
    for (std::size_t i = 0; i < run.traces.size(); ++i) timeline.add(run.states[i + 1], run.traces[i]);
    return timeline;
}

void expectSame(const WorldState& expected, const WorldState& found) {
    const auto difference = firstDifference(expected, found);
    EXPECT_FALSE(difference) << "tick " << expected.tick << ": " << difference->message();
}

/// Someone takes over robot 2 for some ticks, and robot 4 once.
std::vector<RobotDecision> takenOver(std::int64_t tick) {
    std::vector<RobotDecision> decisions;
    Decision decision;
    decision.command = Command{0.7, -0.0};
    if (tick >= 100 && tick < 150) decisions.push_back({2, decision});
    if (tick == 204) decisions.push_back({4, {}});
    return decisions;
}

TEST(Timeline, EveryTickIsReachedAsItWas) {
    const Scenario scenario(matchParts());
    const StraightRun run = runMatch(scenario, scenario.initialState(), 400, takenOver);
    const Timeline timeline = timelineOf(run, 60);
    EXPECT_EQ(timeline.first(), 0);
    EXPECT_EQ(timeline.last(), 400);
    EXPECT_EQ(timeline.blocks().size(), 7u);
    Playback playback(scenario);
    for (std::int64_t tick = 400; tick >= 0; --tick) {
        const auto reached = playback.reach(timeline, tick);
        ASSERT_TRUE(reached) << reached.error().message();
        EXPECT_TRUE(reached->worldSame && reached->memoriesSame) << tick;
        expectSame(run.states[static_cast<std::size_t>(tick)], reached->state);
    }
    EXPECT_FALSE(playback.reach(timeline, 401));
    EXPECT_FALSE(playback.reach(timeline, -1));
}

TEST(Timeline, TheRunHasContactsKicksAndGoalsToTell) {
    const Scenario scenario(matchParts());
    const StraightRun run = runMatch(scenario, scenario.initialState(), 3000);
    std::size_t contacts = 0, kicks = 0, hits = 0;
    for (const StepTrace& trace : run.traces) {
        contacts += trace.contacts.size();
        kicks += trace.kicks.size();
        for (const StepTrace::Kicked& kick : trace.kicks) hits += kick.hit;
    }
    EXPECT_GT(contacts, 1000u);
    EXPECT_GT(kicks, 50u);
    EXPECT_GT(hits, 0u);
}

/// Going on tick by tick, from wherever, also through keyframes and where decisions came from outside.
TEST(Timeline, AdvancingGivesEveryTickAndWhatItTold) {
    const Scenario scenario(matchParts());
    const StraightRun run = runMatch(scenario, scenario.initialState(), 260, takenOver);
    const Timeline timeline = timelineOf(run, 60);
    Playback playback(scenario);
    StepTrace trace;
    for (const std::int64_t start : {0, 59, 60, 120, 121, 203}) {
        auto reached = playback.reach(timeline, start);
        ASSERT_TRUE(reached);
        while (reached->state.tick < timeline.last()) {
            const auto advanced = playback.advance(timeline, *reached, trace);
            ASSERT_TRUE(advanced) << advanced.error().message();
            EXPECT_TRUE(reached->worldSame && reached->memoriesSame) << reached->state.tick;
            const auto tick = static_cast<std::size_t>(reached->state.tick);
            expectSame(run.states[tick], reached->state);
            const StepTrace& expected = run.traces[tick - 1];
            ASSERT_EQ(trace.contacts.size(), expected.contacts.size());
            for (std::size_t i = 0; i < trace.robots.size(); ++i) {
                EXPECT_EQ(trace.robots[i].observed, expected.robots[i].observed);
                EXPECT_TRUE(trace.robots[i].decision.sameOrders(expected.robots[i].decision));
            }
        }
        EXPECT_FALSE(playback.advance(timeline, *reached, trace));
        EXPECT_EQ(reached->state.tick, timeline.last());
    }
}

/// Without the controllers the world is still reached exactly, and only the world.
TEST(Timeline, OtherControllersDoNotMatter) {
    const Scenario scenario(matchParts());
    const StraightRun run = runMatch(scenario, scenario.initialState(), 200, takenOver);
    const Timeline timeline = timelineOf(run, 50);
    MatchOptions other;
    other.controller = std::make_shared<const Rover>(1);
    const Scenario changed(matchParts(other));
    Playback playback(changed);
    for (const std::int64_t tick : {49, 50, 51, 99, 130, 200}) {
        const auto reached = playback.reach(timeline, tick);
        ASSERT_TRUE(reached);
        EXPECT_TRUE(reached->worldSame);
        EXPECT_EQ(reached->memoriesSame, tick % 50 == 0) << tick;
        const auto difference =
            firstDifference(run.states[static_cast<std::size_t>(tick)], reached->state, StateScope::world);
        EXPECT_FALSE(difference) << difference->message();
    }
}

TEST(Timeline, ControllersThatDifferAreAskedOnce) {
    const Scenario scenario(matchParts());
    const Timeline timeline = timelineOf(runMatch(scenario, scenario.initialState(), 100), 50);
    int asked = 0;
    MatchOptions other;
    other.controller = std::make_shared<const Rover>(1, 0, &asked);
    const Scenario changed(matchParts(other));
    Playback playback(changed);
    EXPECT_TRUE(playback.reach(timeline, 20)->worldSame);
    const int first = asked;
    EXPECT_GT(first, 0);
    EXPECT_TRUE(playback.reach(timeline, 80)->worldSame);
    EXPECT_EQ(asked, first);
}

TEST(Timeline, OtherPhysicsIsNoticed) {
    const Scenario scenario(matchParts());
    const StraightRun run = runMatch(scenario, scenario.initialState(), 100);
    const Timeline timeline = timelineOf(run, 50);
    ScenarioParts parts = matchParts();
    parts.scene.robotTypes[0].mass *= 1.01;
    parts.scene.environment.floor.rollingDeceleration *= 1.01;
    const Scenario changed(std::move(parts));
    EXPECT_FALSE(Playback(changed).reach(timeline, 99)->worldSame);
    EXPECT_TRUE(Playback(changed).reach(timeline, 50)->worldSame);
}

TEST(Timeline, StatesOfAnotherScenarioAreErrors) {
    const Scenario scenario(matchParts());
    const Timeline timeline = timelineOf(runMatch(scenario, scenario.initialState(), 10), 5);
    MatchOptions few;
    few.robots = 3;
    const Scenario smaller(matchParts(few));
    const auto reached = Playback(smaller).reach(timeline, 7);
    ASSERT_FALSE(reached);
    EXPECT_NE(reached.error().message().find("8 robots; the scenario has 3"), std::string::npos)
        << reached.error().message();
}

TEST(Playback, InvalidStatesAreNamed) {
    const Scenario scenario(matchParts());
    const WorldState good = runMatch(scenario, scenario.initialState(), 300).states.back();
    EXPECT_EQ(validate(scenario, good), "");
    const auto expectInvalid = [&](const char* part, auto change) {
        WorldState state = good;
        change(state);
        EXPECT_NE(validate(scenario, state).find(part), std::string::npos) << part << ": " << validate(scenario, state);
    };
    expectInvalid("objects", [](WorldState& s) { s.objects.pop_back(); });
    expectInvalid("goals", [](WorldState& s) { s.goals.clear(); });
    expectInvalid("commands", [](WorldState& s) { s.commands.pop_back(); });
    expectInvalid("memory", [](WorldState& s) { s.memory.pop_back(); });
    expectInvalid("past", [](WorldState& s) { s.past.clear(); });
    expectInvalid("robot 3 with a broken history", [](WorldState& s) { s.robots[2].commandCount = 1000; });
    expectInvalid("kick", [](WorldState& s) { s.kicks.push_back({0, 8, 0, 1}); });
    expectInvalid("kick", [](WorldState& s) { s.kicks.push_back({0, 0, 1, 1}); });
    expectInvalid("contact", [](WorldState& s) { s.contacts.push_back({10}); });
    expectInvalid("finite", [](WorldState& s) { s.robots[7].pose.heading = std::nan(""); });
    expectInvalid("finite", [](WorldState& s) { s.objects[0].roll_W.x = INFINITY; });
}

TEST(History, ForgetsTheEarliestWhereMemoryIsShort) {
    const Scenario scenario(matchParts());
    const StraightRun run = runMatch(scenario, scenario.initialState(), 600);
    History::Options options;
    options.keyframeInterval = 25;
    const Timeline whole = timelineOf(run, 25);
    options.mostBytes = whole.size() / 2;
    History history(run.states.front(), options);
    std::size_t largest = 0;
    for (std::size_t i = 0; i < run.traces.size(); ++i) {
        history.add(run.states[i + 1], run.traces[i]);
        largest = std::max(largest, history.size());
    }
    EXPECT_LE(largest, options.mostBytes + whole.size() / 20);
    const Timeline& timeline = history.branches()[0].timeline;
    EXPECT_EQ(timeline.last(), 600);
    EXPECT_GT(timeline.first(), 200);
    EXPECT_LT(timeline.first(), 400);
    EXPECT_EQ(timeline.first() % 25, 0);
    Playback playback(scenario);
    for (std::int64_t tick = timeline.first(); tick <= 600; tick += 7)
        expectSame(run.states[static_cast<std::size_t>(tick)], playback.reach(timeline, tick)->state);
    EXPECT_FALSE(playback.reach(timeline, timeline.first() - 1));
}

TEST(History, ForgetsOfTheBranchThatHasMoreThanItsLastBlock) {
    const Scenario scenario(matchParts());
    const StraightRun run = runMatch(scenario, scenario.initialState(), 20);
    const StraightRun longer = runMatch(scenario, run.states[10], 300);
    History::Options options;
    options.keyframeInterval = 25;
    options.mostBytes = timelineOf(longer, 25).size() / 2;
    History history(run.states.front(), options);
    for (std::size_t i = 0; i < run.traces.size(); ++i) history.add(run.states[i + 1], run.traces[i]);
    const std::uint32_t branch = history.beginBranch(0, longer.states.front(), "");
    for (std::size_t i = 0; i < longer.traces.size(); ++i) history.add(longer.states[i + 1], longer.traces[i], branch);
    EXPECT_LE(history.size(), options.mostBytes * 11 / 10);
    EXPECT_EQ(history.branches()[0].timeline.first(), 0);
    EXPECT_GT(history.branches()[1].timeline.first(), 100);
}

TEST(History, BranchesHaveTheirOwnFuture) {
    const Scenario scenario(matchParts());
    const StraightRun run = runMatch(scenario, scenario.initialState(), 150);
    History history(run.states.front());
    for (std::size_t i = 0; i < run.traces.size(); ++i) history.add(run.states[i + 1], run.traces[i]);
    WorldState moved = run.states[70];
    moved.objects[0].velocity_W.x += 2;
    const StraightRun other = runMatch(scenario, moved, 60);
    const std::uint32_t branch = history.beginBranch(0, moved, "a faster ball");
    for (std::size_t i = 0; i < other.traces.size(); ++i) history.add(other.states[i + 1], other.traces[i], branch);
    ASSERT_EQ(history.branches().size(), 2u);
    EXPECT_EQ(history.branches()[1].tick, 70);
    EXPECT_EQ(history.branches()[1].name, "a faster ball");
    Playback playback(scenario);
    expectSame(run.states[120], playback.reach(history.branches()[0].timeline, 120)->state);
    expectSame(other.states[50], playback.reach(history.branches()[1].timeline, 120)->state);
    EXPECT_FALSE(playback.reach(history.branches()[1].timeline, 69));
}

TEST(DecisionBytes, ComeBackToTheBit) {
    StepTrace trace;
    trace.clear(300, 0);
    const auto decide = [&](std::size_t robot, bool observed) -> Decision& {
        trace.robots[robot].decided = true;
        trace.robots[robot].observed = observed;
        return trace.robots[robot].decision;
    };
    decide(0, true).command = Command{-0.0, 1e-310};
    decide(7, false).earlier = {{-5, {1, 2}}, {std::int64_t{1} << 60, {3, -4}}};
    decide(255, true).kicks = {{0, 0.25}, {200, 1}};
    decide(299, false).fault = std::string(1000, 'x');
    decide(8, true);
    trace.robots[7].decision.annotations.emplace_back();
    std::string bytes;
    appendDecisions(trace, bytes);
    trace.clear(300, 0);
    appendDecisions(trace, bytes);

    DecisionReader reader(bytes);
    ASSERT_TRUE(reader.next(DecisionsOf::all));
    ASSERT_EQ(reader.decisions().size(), 5u);
    EXPECT_EQ(reader.decisions()[0].robot, 0u);
    EXPECT_TRUE(identical(*reader.decisions()[0].decision.command, {-0.0, 1e-310}));
    EXPECT_EQ(reader.decisions()[1].decision.earlier,
              (std::vector<StampedCommand>{{-5, {1, 2}}, {std::int64_t{1} << 60, {3, -4}}}));
    EXPECT_EQ(reader.decisions()[2].robot, 8u);
    EXPECT_FALSE(reader.decisions()[2].decision.command);
    EXPECT_EQ(reader.decisions()[3].decision.kicks, (std::vector<Kick>{{0, 0.25}, {200, 1}}));
    EXPECT_EQ(reader.decisions()[4].decision.fault.size(), 1000u);
    ASSERT_TRUE(reader.next(DecisionsOf::all));
    EXPECT_TRUE(reader.decisions().empty());
    EXPECT_TRUE(reader.done());
    EXPECT_FALSE(reader.next(DecisionsOf::all));

    DecisionReader outside(bytes);
    ASSERT_TRUE(outside.next(DecisionsOf::outside));
    ASSERT_EQ(outside.decisions().size(), 2u);
    EXPECT_EQ(outside.decisions()[0].robot, 7u);
    EXPECT_EQ(outside.decisions()[1].robot, 299u);

    for (std::size_t size = 0; size + 1 < bytes.size(); ++size)
        EXPECT_FALSE(DecisionReader(std::string_view(bytes).substr(0, size)).next(DecisionsOf::all)) << size;
}

TEST(Decisions, OfMoreRobotsThanThereEverAreAreRefused) {
    const std::string_view last("\1\xbf\x84\x3d\0", 5), beyond("\1\xc0\x84\x3d\0", 5);  // of robot 999 999 and the next
    DecisionReader reader(last);
    EXPECT_TRUE(reader.next(DecisionsOf::all));
    EXPECT_EQ(reader.decisions().at(0).robot, 999'999u);
    EXPECT_FALSE(DecisionReader(beyond).next(DecisionsOf::all));
}

}  // namespace
}  // namespace mrose
