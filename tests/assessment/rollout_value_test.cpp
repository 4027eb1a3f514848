#include "assessment/rollout_value.h"

#include <gmock/gmock.h>

#include "assessment/log_scenario.h"
#include "assessment/played_scenarios.h"
#include "assessment/test_models.h"
#include "condition/condition.h"
#include "scenario/log_excerpt.h"
#include "scenario/scenario_file.h"
#include "simulation/step.h"
#include "support/places.h"
#include "support/shipped.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

using testing::HasSubstr;

/// A log of Creates that drive a gentle curve side by side; the second is not seen any more after 9 s.
Log twoCreates() {
    Log log;
    log.source = "Creates";
    log.format = "mrclam";
    for (const std::string name : {"1", "2"}) {
        RobotLog robot{name, {}, {}};
        robot.trajectories.push_back(obedientTrajectory(10 * second, 20 * second, [](double t) {
            return Command{0.1, 0.02 * t};
        }));
        for (StampedPose& stamped : robot.trajectories[0].poses) stamped.pose.y += name == "1" ? 0 : 1.5;
        if (name == "2")
            std::erase_if(robot.trajectories[0].poses,
                          [](const StampedPose& stamped) { return stamped.time > 19 * second; });
        log.robots.push_back(std::move(robot));
    }
    return log;
}

struct LoadedLog {
    Log log;
    std::optional<ScenarioValue> value;
    std::optional<LogWorld> world;
};

void load(LoadedLog& loaded, const std::string& robotFile = "") {
    const auto made = scenarioOfLog(loaded.log, "/logs/it", shippedKinds(), robotFile);
    ASSERT_TRUE(made) << made.error().message();
    DiskDescriptions disk({sourceFolder(), {}, ""});
    auto scenario = loadScenario(*made, disk, {{}, false});
    ASSERT_TRUE(scenario) << scenario.error().message();
    loaded.value.emplace(scenario->value);
    auto world = LogWorld::create(std::move(scenario->parts), std::make_shared<const Log>(loaded.log));
    ASSERT_TRUE(world) << world.error().message();
    loaded.world.emplace(std::move(*world));
}

/// Both go on alike, from the value alone, and so does what it was opened as.
void expectSameRun(const OpenedRollout& rollout, LogWorld::Opened opened, int ticks) {
    auto loaded = loadScenario(ScenarioValue::parse(rollout.value->bytes()).value());
    ASSERT_TRUE(loaded) << loaded.error().message();
    const Scenario again(std::move(loaded->parts));
    WorldState state = again.initialState();
    ASSERT_EQ(hashOf(state), hashOf(opened.state));
    ASSERT_EQ(hashOf(rollout.state), hashOf(opened.state));
    StepBuffers buffers;
    for (int i = 0; i < ticks; ++i) {
        step(again, state, buffers);
        step(*opened.scenario, opened.state, buffers);
        ASSERT_EQ(hashOf(state), hashOf(opened.state)) << "tick " << i;
    }
}

TEST(RolloutValue, RolloutOfTheShippedLogRunsFromItsValueAloneAsItWasOpened) {
    LoadedLog loaded{shippedLog(), {}, {}};
    ASSERT_NO_FATAL_FAILURE(load(loaded));
    const LogWorld& world = *loaded.world;
    ASSERT_GT(world.sessions().size(), 1u);
    const RolloutRequest request{1, 7'300'000'123, 100};
    const Nanoseconds length = 10 * second;
    const LogWorld::Opened opened = world.openAt(request.session, request.start, length, 7);
    const auto rollout = openRollout(world, *loaded.value, "/logs/it", request, 7, length, length);
    ASSERT_TRUE(rollout) << rollout.error().message();
    EXPECT_EQ(rollout->scenario->parts().duration, length);
    expectSameRun(*rollout, opened, 500);
}

TEST(RolloutValue, RobotThatNobodySeesIsNoPartOfIt) {
    LoadedLog loaded{twoCreates(), {}, {}};
    ASSERT_NO_FATAL_FAILURE(load(loaded));
    const LogWorld& world = *loaded.world;
    for (const Nanoseconds start : {2 * second, 12 * second}) {
        const LogWorld::Opened opened = world.openAt(0, start, 5 * second, 1);
        const auto rollout = openRollout(world, *loaded.value, "/logs/it", {0, start, 50}, 1, 5 * second, 5 * second);
        ASSERT_TRUE(rollout) << rollout.error().message();
        EXPECT_EQ(rollout->value->bodyPath("create 1"), "robot[1]");
        const bool present = start <= 9 * second;
        EXPECT_EQ(rollout->value->bodyPath("create 2"), present ? "robot[2]" : "");
        expectSameRun(*rollout, opened, 250);
    }
}

/// Windows of one robot may lie before the log's start, at which all of its robots are there.
TEST(RolloutValue, RolloutMayBeginBeforeTheOthersAreThere) {
    Log log = twoCreates();
    Trajectory& late = log.robots[0].trajectories[0];
    std::erase_if(late.poses, [](const StampedPose& stamped) { return stamped.time < 13 * second; });
    LoadedLog loaded{log, {}, {}};
    ASSERT_NO_FATAL_FAILURE(load(loaded));
    const LogWorld& world = *loaded.world;
    const Nanoseconds start = -2 * second;
    const LogWorld::Opened opened = world.openAt(0, start, 5 * second, 1);
    ASSERT_TRUE(!opened.starts[0] && opened.starts[1]);
    const auto rollout = openRollout(world, *loaded.value, "/logs/it", {0, start, 50, 1}, 1, 5 * second, 5 * second);
    ASSERT_TRUE(rollout) << rollout.error().message();
    expectSameRun(*rollout, opened, 250);
    // Who is left out takes no number away.
    for (const Scenario* scenario : {opened.scenario.get(), rollout->scenario.get()}) {
        ASSERT_EQ(scenario->scene().robots.size(), 1u);
        EXPECT_EQ(scenario->scene().robots[0].name, "create 2");
        EXPECT_EQ(scenario->scene().placeOf(0), 1u);
        auto same = compileCondition("robot[2].x == robot['create 2'].x", *scenario);
        ASSERT_TRUE(same) << same.error().message();
        EXPECT_EQ(same->holds({scenario, &opened.state}).value_or(false), true);
        EXPECT_FALSE(compileCondition("robot[1].x > 0", *scenario));
    }
    // Before the robot itself is there no start is known.
    const auto early = excerptOf(log, {.robot = "2", .start = -4});
    ASSERT_FALSE(early);
    EXPECT_THAT(early.error().message(), HasSubstr("robot \"2\" begins "));
}

TEST(LogScenario, TellsWhatIsMissingForALogOfUnknownRobots) {
    Log log = twoCreates();
    log.format = "csv";
    const auto made = scenarioOfLog(log, "/logs/it", shippedKinds());
    ASSERT_FALSE(made);
    EXPECT_THAT(made.error().message(), HasSubstr("--robot"));
    EXPECT_THAT(made.error().message(), HasSubstr("a scenario whose robots play it"));
    LoadedLog loaded{log, {}, {}};
    ASSERT_NO_FATAL_FAILURE(load(loaded, "husky.toml"));
    EXPECT_EQ(loaded.world->parts().scene.typeOf(0).name, "Husky");
    const Polygon& area = loaded.world->parts().scene.environment.floor.area;
    for (const RobotLog& robot : log.robots)
        for (const StampedPose& stamped : robot.trajectories[0].poses) {
            EXPECT_GE(stamped.pose.x, area[0].x + 1);
            EXPECT_LE(stamped.pose.y, area[2].y - 1);
        }
}

TEST(LogScenario, CreatesOfTheNetworkAreKnownByTheirNumbers) {
    LoadedLog loaded{twoCreates(), {}, {}};
    ASSERT_NO_FATAL_FAILURE(load(loaded));
    const LearnedModel& model = *learnedModel(loaded.world->parts().scene.modelOf(1));
    EXPECT_EQ(model.network().robots[static_cast<std::size_t>(model.robot())], "2");
}

}  // namespace
}  // namespace mrose
