#include "assessment/log_scenario.h"

#include <gmock/gmock.h>

#include "support/shipped.h"
#include "support/units.h"

namespace mrose {
namespace {

using testing::HasSubstr;

/// 10 s of a robot that is sent ahead, between two places.
RobotLog driven(const std::string& robot, const Pose& from, const Pose& to) {
    RobotLog log{robot, {Trajectory{}}, {}};
    Trajectory& trajectory = log.trajectories[0];
    for (int i = 0; i <= 500; ++i) {
        const double share = i / 500.0;
        trajectory.commands.push_back({i * 20 * ms, {0.1, 0}});
        trajectory.poses.push_back(
            {i * 20 * ms, {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y), 0}});
    }
    return log;
}

Log csvLogOf(std::vector<RobotLog> robots) { return {"some.csv", "csv", 0, std::move(robots), {}, false}; }

std::string refusal(const Expected<void>& checked) { return checked ? "" : checked.error().message(); }

TEST(LogScenario, PlaceInMillimetresIsRefusedByTheLogsOwnName) {
    const Log log = csvLogOf({driven("a", {-2602, 0, 0}, {2604, 100, 0})});
    const auto made = scenarioOfLog(log, "/logs/some.csv", shippedKinds(), "pioneer1.toml");
    ASSERT_FALSE(made);
    for (const auto& error : {made.error().message(), refusal(checkPlayable(log, shippedKinds()))}) {
        EXPECT_THAT(error, HasSubstr("some.csv: "));
        EXPECT_THAT(error, HasSubstr("spans 5206 m"));
        EXPECT_THAT(error, HasSubstr("expected in metres"));
    }
    const Log near = csvLogOf({driven("a", {-900, 0, 0}, {900, 100, 0})});
    EXPECT_TRUE(scenarioOfLog(near, "/logs/some.csv", shippedKinds(), "pioneer1.toml"));
    EXPECT_EQ(refusal(checkPlayable(near, shippedKinds())), "");
}

TEST(LogScenario, CommandsAndTruthOfOtherTimesAreRefusedBeforeTheKindIsAsked) {
    Log log = csvLogOf({driven("a", {0, 0, 0}, {1, 0, 0}), driven("b", {0, 1, 0}, {1, 1, 0})});
    EXPECT_EQ(refusal(checkPlayable(log, shippedKinds())), "");
    for (StampedPose& stamped : log.robots[1].trajectories[0].poses) stamped.time += 100'000 * ms;
    EXPECT_THAT(refusal(checkPlayable(log, shippedKinds())), HasSubstr("expected both of the same time"));
    EXPECT_EQ(refusal(checkPlayable(log, shippedKinds(), {"a"})), "") << "the other one is not asked for";
    log.robots[1].trajectories.push_back(log.robots[0].trajectories[0]);
    EXPECT_EQ(refusal(checkPlayable(log, shippedKinds())), "") << "another trajectory of it can be compared";
}

TEST(LogScenario, RobotsWithoutCommandsOrTruthAreLeftToThoseThatHaveBoth) {
    Log log = csvLogOf({driven("a", {0, 0, 0}, {1, 0, 0}), driven("b", {0, 1, 0}, {1, 1, 0})});
    log.robots[1].trajectories[0].poses.clear();
    EXPECT_EQ(refusal(checkPlayable(log, shippedKinds())), "");
    EXPECT_THAT(refusal(checkPlayable(log, shippedKinds(), {"b"})), HasSubstr("has no ground truth of robot \"b\""))
        << "asked for";
    log.robots[0].trajectories[0].commands.clear();
    EXPECT_THAT(refusal(checkPlayable(log, shippedKinds())), HasSubstr("has no commands of robot \"a\""));
}

TEST(LogScenario, PlayersReadTheSensorsThatReportSubjects) {
    Log log = csvLogOf({driven("a", {0, 0, 0}, {1, 0, 0}), driven("b", {0, 1, 0}, {1, 1, 0})});
    SensorLog camera{"camera"}, localisation{"localisation"};
    camera.looks = {{0, {}}};
    localisation.poses = {{0, {}}};
    log.robots[1].trajectories[0].sensors = {localisation, camera};
    const auto made = scenarioOfLog(log, "/logs/some.csv", shippedKinds(), "pioneer1.toml");
    ASSERT_TRUE(made) << made.error().message();
    EXPECT_EQ(made->at("robot[1].controller.reads"), nullptr);
    const Value* const reads = made->at("robot[2].controller.reads");
    ASSERT_TRUE(reads && reads->asArray());
    EXPECT_EQ(*reads, Value(Value::Array{"camera"}));
}

}  // namespace
}  // namespace mrose
