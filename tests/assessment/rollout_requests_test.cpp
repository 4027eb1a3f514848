// Which rollouts of a log are the default.
#include "assessment/rollout_requests.h"

#include <gmock/gmock.h>

#include "assessment/log_scenario.h"
#include "assessment/test_models.h"
#include "assessment/windows.h"
#include "scenario/scenario_file.h"
#include "support/places.h"
#include "support/shipped.h"

namespace mrose {
namespace {

using testing::Eq;
using testing::Optional;

constexpr Nanoseconds tenSeconds = 10 * second;

/// A Husky that drove for so long each time.
LogWorld worldOf(const std::vector<Nanoseconds>& drives, double speed = 0.5) {
    Log log;
    log.source = "drives";
    log.format = "husky-windows";
    log.robots.push_back({"husky", {}, {}});
    for (std::size_t i = 0; i < drives.size(); ++i) {
        log.robots[0].trajectories.push_back(obedientTrajectory(0, drives[i], [speed](double t) {
            return Command{speed, 0.1 * speed * t};
        }));
        log.robots[0].trajectories.back().name = std::to_string(i);
    }
    const auto made = scenarioOfLog(log, "/logs/it", shippedKinds());
    EXPECT_TRUE(made) << made.error().message();
    DiskDescriptions disk({sourceFolder(), {}, ""});
    auto scenario = loadScenario(*made, disk, {{}, false});
    EXPECT_TRUE(scenario) << scenario.error().message();
    auto world = LogWorld::create(std::move(scenario->parts), std::make_shared<const Log>(log));
    EXPECT_TRUE(world) << world.error().message();
    return std::move(*world);
}

std::vector<Nanoseconds> driven(std::size_t count, Nanoseconds length) { return std::vector(count, length); }

std::vector<Nanoseconds> operator+(std::vector<Nanoseconds> a, const std::vector<Nanoseconds>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

TEST(SuitedWindows, LogThatRolloutsCoverNeedsNone) {
    EXPECT_THAT(windowsThatSuit(worldOf({25 * second}), tenSeconds), Eq(std::nullopt));
    EXPECT_THAT(windowsThatSuit(worldOf(driven(2, 19 * second)), tenSeconds), Eq(std::nullopt));
    // 30 s of 58 s lie in rollouts of 10 s, then 30 s of 62 s.
    EXPECT_THAT(windowsThatSuit(worldOf(driven(3, tenSeconds) + driven(7, 4 * second)), tenSeconds), Eq(std::nullopt));
    EXPECT_THAT(windowsThatSuit(worldOf(driven(3, tenSeconds) + driven(8, 4 * second)), tenSeconds),
                Optional(4 * second));
}

TEST(SuitedWindows, NineTenthsOfTheTrajectoriesHoldThem) {
    EXPECT_THAT(windowsThatSuit(worldOf({8 * second}), tenSeconds), Optional(8 * second));
    EXPECT_THAT(windowsThatSuit(worldOf(driven(10, 6 * second) + driven(1, 3 * second)), tenSeconds),
                Optional(6 * second));
    EXPECT_THAT(windowsThatSuit(worldOf(driven(9, 6 * second) + driven(2, 3 * second)), tenSeconds),
                Optional(3 * second));
    EXPECT_THAT(windowsThatSuit(worldOf(driven(4, 1'960'000'000)), tenSeconds), Optional(1'900'000'000)) << "steps";
}

TEST(SuitedWindows, AreThoseOfEvaluate) {
    const LogWorld world = worldOf(driven(5, 1'960'000'000));
    const auto rollouts = rolloutsOfAllWindows(world, windowsThatSuit(world, tenSeconds).value_or(0));
    ASSERT_TRUE(rollouts) << rollouts.error().message();
    const auto evaluated = findWindows(world.log());
    ASSERT_TRUE(evaluated);
    ASSERT_EQ(rollouts->size(), evaluated->size());
    for (std::size_t i = 0; i < rollouts->size(); ++i) {
        const auto& [session, start, steps, robot] = (*rollouts)[i];
        EXPECT_EQ(world.sessions()[session].parts[0].trajectory, (*evaluated)[i].trajectory);
        EXPECT_EQ(start + world.sessions()[session].parts[0].origin, (*evaluated)[i].start);
        EXPECT_EQ(steps, (*evaluated)[i].steps());
        EXPECT_EQ(robot, std::optional<std::size_t>(0));
    }
}

TEST(SuitedWindows, RobotThatStandsHasNone) {
    const LogWorld world = worldOf(driven(3, 4 * second), 0);
    EXPECT_THAT(windowsThatSuit(world, tenSeconds), Optional(4 * second));
    const auto rollouts = rolloutsOfAllWindows(world, 4 * second);
    ASSERT_FALSE(rollouts);
    EXPECT_THAT(rollouts.error().message(), testing::HasSubstr("3 in which the robot hardly moves"));
}

TEST(Stretches, OfALogThatIsTooShortAskForALongerOne) {
    const LogWorld world = worldOf({60 * ms});
    for (const Nanoseconds start : {Nanoseconds{0}, second})
        EXPECT_EQ(rolloutsOf(world, {start, {}, {}}).error().message(),
                  "drives: the ground truth ends 0.06 s after the log's start; expected a log that goes on for at "
                  "least 0.1 s once all of its robots are there");
}

TEST(LogScenario, RobotIsNotNamedTwice) { EXPECT_EQ(worldOf({tenSeconds}).robots()[0].name, "husky"); }

}  // namespace
}  // namespace mrose
