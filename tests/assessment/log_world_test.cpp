#include "assessment/log_world.h"

#include <gtest/gtest.h>

#include "assessment/played_scenarios.h"
#include "assessment/rollout_requests.h"
#include "assessment/test_models.h"
#include "logs/pose_grid.h"
#include "simulation/step.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

Command turning(double t) { return {0.1, 0.05 * t}; }

/// Robots "a" and "b", each with two trajectories that are called alike; b's begin a second later.
Log twoSessions() {
    Log log;
    log.source = "made-up";
    for (const std::string name : {"a", "b"}) {
        RobotLog robot{name, {}, {}};
        for (const Nanoseconds begin : {10, 100}) {
            robot.trajectories.push_back(obedientTrajectory((begin + (name == "b")) * second, 20 * second, turning));
            robot.trajectories.back().name = begin == 10 ? "early" : "late";
        }
        log.robots.push_back(std::move(robot));
    }
    return log;
}

ScenarioParts players(const Log& log) { return playersOf(log, std::make_shared<const HeldCommandModel>()); }

std::string errorOf(const Expected<LogWorld>& world) { return world ? "" : world.error().message(); }

TEST(LogWorld, TakesHoldTrajectoriesOfOneNameOnOneClock) {
    const Log log = twoSessions();
    const auto world = LogWorld::create(players(log), std::make_shared<const Log>(log));
    ASSERT_TRUE(world) << world.error().message();
    ASSERT_EQ(world->sessions().size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
        const LogSession& session = world->sessions()[k];
        EXPECT_EQ(session.name, k == 0 ? "early" : "late");
        for (const LogSession::Part& part : session.parts) {
            EXPECT_EQ(part.trajectory, k);
            EXPECT_EQ(part.origin, (k == 0 ? 11 : 101) * second) << "when the later one begins";
        }
        EXPECT_EQ(session.length, 20 * second);
    }
}

TEST(LogWorld, KeepsItsLog) {
    auto log = std::make_shared<const Log>(twoSessions());
    const std::weak_ptr<const Log> kept = log;
    {
        const auto world = LogWorld::create(players(*log), log);
        log.reset();
        ASSERT_TRUE(world) << world.error().message();
        EXPECT_EQ(world->sharedLog(), kept.lock());
        EXPECT_FALSE(world->trajectory(1, 0).poses.empty());
    }
    EXPECT_TRUE(kept.expired());
}

TEST(LogWorld, NamedTrajectoryAndStartCountFromItsOwnBeginning) {
    const Log log = twoSessions();
    ScenarioParts parts = players(log);
    parts.players[0].excerpt.trajectory = "late";
    parts.players[0].excerpt.start = 2.5;
    parts.players[1].excerpt.trajectory = "early";
    const auto world = LogWorld::create(std::move(parts), std::make_shared<const Log>(log));
    ASSERT_TRUE(world) << world.error().message();
    ASSERT_EQ(world->sessions().size(), 1u);
    EXPECT_EQ(world->sessions()[0].parts[0].origin, 102'500'000'000);
    EXPECT_EQ(world->sessions()[0].parts[1].origin, 11 * second);
    EXPECT_EQ(&world->trajectory(0, 0), &world->log().robots[0].trajectories[1]);
}

TEST(LogWorld, OpensWhereTheRealRobotsWereAsFastAndToldTheSame) {
    const Log log = twoSessions();
    const auto world = LogWorld::create(players(log), std::make_shared<const Log>(log));
    ASSERT_TRUE(world) << world.error().message();
    const LogWorld::Opened opened = world->openAt(1, 4 * second, 3 * second, 17);
    EXPECT_EQ(opened.state.seed, 17u);
    for (std::size_t i = 0; i < 2; ++i) {
        const MeasuredStart real = measuredStart(log.robots[i].trajectories[1], 105 * second);
        const RobotState& robot = opened.state.robots[opened.bodies[i]];
        EXPECT_EQ(robot.pose, real.pose);
        // Measured 0.1 s before, and carried on by the model, which does at once what it is told.
        EXPECT_EQ(real.velocity.time, 105 * second - 90 * ms);
        const Command since = turning(3.9 + (i == 0 ? 1 : 0));
        EXPECT_EQ(robot.velocity_B.x, since.v);
        EXPECT_NEAR(robot.velocity_B.rotation, since.w, 1e-15);
        EXPECT_EQ(robot.nextControl, 0);
        WorldState after = stepped(*opened.scenario, opened.state);
        const CommandView commands = opened.scenario->commandsOf(after, opened.bodies[i]);
        EXPECT_EQ(commands.at(0), turning(4.0 + (i == 0 ? 1 : 0))) << "each by its own clock";
        EXPECT_EQ(commands.issueTime(commands.size() - 1), 0);
    }
}

TEST(LogWorld, RobotsThatAreNotChosenAreNotInIt) {
    const Log log = twoSessions();
    const auto world = LogWorld::create(players(log), std::make_shared<const Log>(log), {"b"});
    ASSERT_TRUE(world) << world.error().message();
    ASSERT_EQ(world->robots().size(), 1u);
    EXPECT_EQ(world->robots()[0].name, "simulated b");
    const LogWorld::Opened opened = world->openAt(0, 0, second, 1);
    ASSERT_EQ(opened.state.robots.size(), 1u);
    EXPECT_EQ(opened.scenario->scene().robots[0].name, "simulated b");
}

TEST(LogWorld, RobotsOfWhichCommandsOrTruthAreMissingAreLeftOutAndNamed) {
    const Log log = twoSessions();
    for (const bool truth : {false, true}) {
        Log half = log;
        for (Trajectory& trajectory : half.robots[0].trajectories)
            truth ? trajectory.commands.clear() : trajectory.poses.clear();
        const auto world = LogWorld::create(players(log), std::make_shared<const Log>(half));
        ASSERT_TRUE(world) << world.error().message();
        ASSERT_EQ(world->robots().size(), 1u);
        EXPECT_EQ(world->robots()[0].realName, "b");
        EXPECT_EQ(world->leftOut(),
                  std::vector<std::string>{std::string("Robot \"a\" is not compared: the log has no ") +
                                           (truth ? "commands" : "ground truth") + " of it."});
        const auto chosen = LogWorld::create(players(log), std::make_shared<const Log>(half), {"b"});
        ASSERT_TRUE(chosen) << chosen.error().message();
        EXPECT_TRUE(chosen->leftOut().empty());
        const LogWorld::Opened opened = world->openAt(0, 0, second, 1), alone = chosen->openAt(0, 0, second, 1);
        EXPECT_EQ(hashOf(opened.state), hashOf(alone.state));
    }
    EXPECT_TRUE(LogWorld::create(players(log), std::make_shared<const Log>(log))->leftOut().empty());
}

TEST(LogWorld, ErrorsSayWhatToDo) {
    const Log log = twoSessions();
    EXPECT_EQ(errorOf(LogWorld::create({}, std::make_shared<const Log>(log))),
              "plays no log; expected a robot with controller = { kind = \"log_player\", ... }");
    EXPECT_EQ(errorOf(LogWorld::create(players(log), std::make_shared<const Log>(log), {"c"})),
              "made-up: has no robot \"c\"");
    ScenarioParts one = players(log);
    one.players.pop_back();
    EXPECT_EQ(errorOf(LogWorld::create(one, std::make_shared<const Log>(log), {"b"})),
              "--robots: has no robot that plays robot \"b\" of a log");
    ScenarioParts named = players(log);
    named.players[1].excerpt.trajectory = "never";
    EXPECT_EQ(errorOf(LogWorld::create(named, std::make_shared<const Log>(log))),
              "made-up: has no trajectory \"never\" of robot \"b\"");

    Log fewer = log;
    fewer.robots.pop_back();
    EXPECT_EQ(errorOf(LogWorld::create(players(log), std::make_shared<const Log>(fewer))),
              "made-up: has no robot \"b\", which \"simulated b\" plays; --robots a compares those that it has");
    Log other = log;
    other.robots[0].robot = "x";
    other.robots[1].robot = "y";
    EXPECT_EQ(errorOf(LogWorld::create(players(log), std::make_shared<const Log>(other))),
              "made-up: has no robot \"a\", which \"simulated a\" plays; expected a log of the scenario's robots");
    Log blind = log;
    for (Trajectory& trajectory : blind.robots[1].trajectories) trajectory.poses.clear();
    EXPECT_EQ(
        errorOf(LogWorld::create(players(log), std::make_shared<const Log>(blind), {"a", "b"})),
        "made-up: has no ground truth of robot \"b\": nothing to compare with; expected its poses (x, y, heading) "
        "beside its commands");
    Log silent = log;
    for (Trajectory& trajectory : silent.robots[1].trajectories) trajectory.commands.clear();
    EXPECT_EQ(errorOf(LogWorld::create(players(log), std::make_shared<const Log>(silent), {"a", "b"})),
              "made-up: has no commands of robot \"b\"; expected the commands that it was sent and the poses that it "
              "reached");
    Log unmatched = log;
    for (StampedPose& stamped : unmatched.robots[1].trajectories[0].poses) stamped.time += 1000 * second;
    const std::string said = errorOf(LogWorld::create(players(log), std::make_shared<const Log>(unmatched)));
    EXPECT_EQ(said.find("made-up: has commands of robot \"b\" from "), 0u) << said;
    EXPECT_NE(said.find(" s and its ground truth from 10"), std::string::npos) << said;
    EXPECT_NE(said.find("; expected both of the same time"), std::string::npos) << said;
    Log apart = log;
    for (Trajectory& trajectory : apart.robots[1].trajectories) trajectory.name += " of b";
    EXPECT_EQ(
        errorOf(LogWorld::create(players(log), std::make_shared<const Log>(apart))),
        "made-up: has no trajectory that all robots of the scenario have; expected one to be named beside each log");
}

TEST(RolloutRequests, OneRolloutOrManyUpToTheEndOfTheGroundTruth) {
    const Log log = twoSessions();
    const auto world = LogWorld::create(players(log), std::make_shared<const Log>(log));
    ASSERT_TRUE(world) << world.error().message();
    const auto one = rolloutsOf(*world, {3 * second, 60 * second, std::nullopt});
    ASSERT_TRUE(one);
    ASSERT_EQ(one->size(), 1u) << "of the first session";
    EXPECT_EQ(one->front().start, 3 * second);
    EXPECT_EQ(one->front().steps, 170) << "where the ground truth ends";
    const auto many = rolloutsOf(*world, {3 * second, std::nullopt, 5 * second});
    ASSERT_TRUE(many);
    ASSERT_EQ(many->size(), 6u) << "three in each session";
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ((*many)[i].session, i / 3);
        EXPECT_EQ((*many)[i].start, static_cast<Nanoseconds>(3 + 5 * (i % 3)) * second);
        EXPECT_EQ((*many)[i].steps, 50);
    }
    const auto error = [&](const StretchOptions& options) { return rolloutsOf(*world, options).error().message(); };
    EXPECT_EQ(error({30 * second, {}, {}}),
              "made-up: the ground truth ends 20.0 s after the log's start; expected an earlier --start than 30.0 s");
    EXPECT_EQ(error({3 * second, {}, 18 * second}),
              "made-up: the ground truth ends 20.0 s after the log's start; expected a shorter --every than 18.0 s, no "
              "longer than --duration");
    EXPECT_EQ(error({0, 10 * second, 750'000'000}), "--every: 0.75 s is no whole number of steps of 0.1 s");
    EXPECT_EQ(error({0, 1'050'000'000, {}}), "--duration: 1.05 s is no whole number of steps of 0.1 s");
}

TEST(RolloutRequests, WindowsOfAFileAreAskedOfTheirOwnRobot) {
    const Log log = twoSessions();
    const auto world = LogWorld::create(players(log), std::make_shared<const Log>(log), {"b"});
    ASSERT_TRUE(world) << world.error().message();
    const auto windows = parseWindows("dataset,robot,t_start\n0,a,15\n0,b,105.25\n0,b,15\n", "w.csv");
    ASSERT_TRUE(windows) << windows.error().message();
    const auto requests = requestedRollouts(*world, *windows, {"b"}, 30, "w.csv");
    ASSERT_TRUE(requests) << requests.error().message();
    ASSERT_EQ(requests->size(), 2u);
    EXPECT_EQ((*requests)[0].session, 1u);
    EXPECT_EQ((*requests)[0].start, 4'250'000'000);
    EXPECT_EQ((*requests)[0].robot, std::size_t{0});
    EXPECT_EQ((*requests)[1].start, 4 * second);
    EXPECT_EQ(
        requestedRollouts(*world, *windows, {}, 30, "w.csv").error().message(),
        "w.csv:2: robot: the scenario plays no robot a there; expected windows of its robots, or --robots with those "
        "that it plays");
    EXPECT_EQ(requestedRollouts(*world, *windows, {"c"}, 30, "w.csv").error().message(),
              "w.csv: has no window of the robots that --robots names");
}

}  // namespace
}  // namespace mrose
