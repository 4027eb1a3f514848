#include "behaviour/team_player.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "behaviour/small_field.h"
#include "behaviour/way_to_ball.h"

namespace mrose {
namespace {

TeamPlayer::Options options(std::size_t players) {
    TeamPlayer::Options made;
    made.chase.target = {9, 2.5};
    made.chase.walls = floorPlanOf(walledField(9, 5));
    made.ownGoal = {0, 2.5};
    for (std::uint32_t i = 0; i < players; ++i) made.team.push_back({i, std::to_string(i + 1)});
    return made;
}

/// Players at such places, all alike but for what `change` makes of the options of each.
template <class Change>
SmallWorld field(const std::vector<Pose>& starts, const Point& ball, const Perception& perception, Change change) {
    SmallWorld world(walledField(9, 5));
    for (std::size_t i = 0; i < starts.size(); ++i) {
        TeamPlayer::Options own = options(starts.size());
        change(i, own);
        world.robot(guideRobot(perception), starts[i], std::make_shared<const TeamPlayer>(own), noisyDrive(),
                    static_cast<std::int64_t>(i));
    }
    world.object(ballType(), {ball.x, ball.y, 0});
    return world;
}
const auto asTheyAre = [](std::size_t, TeamPlayer::Options&) {};

std::string entry(const Scenario& scenario, const WorldState& state, std::size_t robot, const std::string& name) {
    for (const MemoryEntry& entry : explained(scenario.controller(robot), scenario.memoryOf(state, robot)))
        if (entry.name == name) return entry.text.empty() ? std::to_string(entry.value) : entry.text;
    return "none";
}

int going(const Scenario& scenario, const WorldState& state) {
    int count = 0;
    for (std::size_t i = 0; i < state.robots.size(); ++i) count += entry(scenario, state, i, "role") == "goes" ? 1 : 0;
    return count;
}

const std::vector<Pose> threePlayers{{1, 1, 0}, {2, 4, 0}, {3.5, 1.5, 0}};

TEST(TeamPlayer, TheNearestGoesAndTheOthersKeepAway) {
    const Scenario scenario = field(threePlayers, {4.5, 2.5}, {}, asTheyAre).scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 5 * ticksPerSecond);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(entry(scenario, state, i, "goer"), "3") << i;
        EXPECT_EQ(entry(scenario, state, i, "role"), i == 2 ? "goes" : "supports");
    }
    const Point ball = position(state.objects[0].pose);
    EXPECT_LT(distance(position(state.robots[2].pose), ball), 0.8);
    for (const std::size_t i : {0u, 1u}) EXPECT_GT(distance(position(state.robots[i].pose), ball), 1);
}

/// Of three players in games of a minute: for how long nobody goes, or several, as shares.
struct Agreement {
    double none = 0, more = 0;
    int advanced = 0;  ///< balls that were brought into the target's half
};
Agreement agreement(std::int64_t games, double hysteresis, Nanoseconds handOver) {
    std::int64_t none = 0, one = 0, more = 0;
    Agreement result;
    for (std::int64_t i = 0; i < games; ++i) {
        std::vector<Pose> starts;
        for (std::int64_t k = 0; k < 3; ++k)
            starts.push_back({1.0 + 1.5 * static_cast<double>(k), draw(3, i, 4, 1, 4), 0});
        const Scenario scenario = field(starts, {draw(3, i, 1, 4.7, 5.2), draw(3, i, 2, 1, 4)}, cameras(),
                                        [&](std::size_t, TeamPlayer::Options& own) {
                                            own.role.hysteresis = hysteresis;
                                            own.handOver = handOver;
                                        })
                                      .scenario();
        WorldState state = scenario.initialState(static_cast<std::uint64_t>(i));
        run(scenario, state, ticksPerSecond);
        bool came = false;
        for (int tick = 0; tick < 60 * ticksPerSecond; ++tick) {
            run(scenario, state, 1);
            const int count = going(scenario, state);
            ++(count == 0 ? none : count == 1 ? one : more);
            came = came || state.objects[0].pose.x > 6;
        }
        result.advanced += came ? 1 : 0;
    }
    const double all = static_cast<double>(none + one + more);
    result.none = static_cast<double>(none) / all;
    result.more = static_cast<double>(more) / all;
    return result;
}

/// By what each believes itself, late and off, with ball and robots all over the field.
TEST(TeamPlayer, NearlyAlwaysOneOfThemGoes) {
    const Agreement of = agreement(6, 1, TeamPlayer::Options().handOver);
    EXPECT_LT(of.none, 0.01);
    EXPECT_LT(of.more, 0.02);
    EXPECT_GE(of.advanced, 5) << "of 6 balls brought into the target's half";
}

/// The players of this field decide at the same instants: without it there is no time between.
TEST(TeamPlayer, WhoStopsLaterRatherHasTwoGoThanNobody) {
    const Agreement atOnce = agreement(10, 0, 0), later = agreement(10, 0, 80'000'000);
    EXPECT_GT(later.more, atOnce.more + 0.0005);
    EXPECT_LE(later.none, atOnce.none);
}

TEST(TeamPlayer, WithoutRadioEachGoesByItself) {
    SmallWorld world = field(threePlayers, {4.5, 2.5}, {}, asTheyAre);
    world.parts().scene.radio.loss = 1;
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 2 * ticksPerSecond);
    EXPECT_EQ(going(scenario, state), 3);
}

TEST(TeamPlayer, WhoSeesNoBallKnowsItFromMates) {
    // The second one looks away from it, and cannot turn.
    const Scenario scenario =
        field({{1, 1.2, 0.4}, {3, 2.5, 3.1416}}, {4, 2.5}, cameras(), [](std::size_t i, auto& own) {
            if (i == 1) own.chase.speed = own.chase.rotation = 0;
        }).scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, ticksPerSecond);
    EXPECT_NEAR(std::stod(entry(scenario, state, 1, "ball x")), 4, 0.4);
    EXPECT_NEAR(std::stod(entry(scenario, state, 1, "ball y")), 2.5, 0.4);
}

TEST(TeamPlayer, AKeeperStaysBeforeItsGoalAndAnotherOneGoes) {
    const Scenario scenario =
        field({{1, 2.5, 0}, {4, 4, 0}}, {1.5, 1}, {}, [](std::size_t i, auto& own) { own.keeper = i == 0; }).scenario();
    WorldState state = scenario.initialState();
    for (int i = 0; i < 20; ++i) {
        run(scenario, state, ticksPerSecond);
        EXPECT_EQ(entry(scenario, state, 0, "role"), "keeps");
        EXPECT_LT(distance(position(state.robots[0].pose), {0, 2.5}), 1.4);
    }
    EXPECT_EQ(entry(scenario, state, 0, "goer"), "2");
    EXPECT_EQ(entry(scenario, state, 1, "role"), "goes");
}

TEST(TeamPlayer, WhereRolesAreFixedTheNamedOneGoesOrNobody) {
    for (const std::int64_t goes : {0, 1}) {
        const Scenario scenario = field(threePlayers, {4.5, 2.5}, {}, [&](std::size_t, auto& own) {
                                      own.choose = TeamPlayer::Choose::fixed;
                                      own.goes = goes;
                                  }).scenario();
        WorldState state = scenario.initialState();
        run(scenario, state, 2 * ticksPerSecond);
        EXPECT_EQ(going(scenario, state), goes);
        EXPECT_EQ(entry(scenario, state, 2, "goer"), goes == 0 ? "nobody" : "1");
    }
}

/// Whose time grows with the distance, and who is slow.
class Slowness final : public LearnedMapping {
public:
    explicit Slowness(double perMetre) : perMetre_(perMetre) {}
    std::size_t inputs() const override { return WayToBall::count; }
    std::size_t outputs() const override { return 1; }
    MappingVariable input(std::size_t index) const override { return {wayToBallNames.begin()[index], "1"}; }
    MappingVariable output(std::size_t) const override { return {"time_s", "s"}; }
    void evaluate(std::span<const double> from, std::span<double> to) const override { to[0] = perMetre_ * from[0]; }
    /// It learned of up to 1 m.
    double beyond(std::span<const double> from) const override { return std::max(0.0, from[0] - 1); }

private:
    double perMetre_;
};

TEST(TeamPlayer, ByLearnedTimeTheFasterOneGoesThoughItIsFarther) {
    const Scenario scenario = field(threePlayers, {4.5, 2.5}, {}, [](std::size_t i, auto& own) {
                                  own.choose = TeamPlayer::Choose::time;
                                  own.time = std::make_shared<const Slowness>(i == 2 ? 10 : 3);
                              }).scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, ticksPerSecond);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(entry(scenario, state, i, "goer"), "2") << i;
    const double far = distance({2, 4}, {4.5, 2.5});
    EXPECT_NEAR(std::stod(entry(scenario, state, 0, "cost of 2")), 3 * far, 0.8) << "as it told";
    const double asked = std::stod(entry(scenario, state, 0, wayToBallNames.begin()[0]));
    EXPECT_GT(asked, 1);
    EXPECT_NEAR(std::stod(entry(scenario, state, 0, beyondLearned)), asked - 1, 1e-5);
}

/// How near it comes to another body, and when it is at the ball, 0.6 m from it.
struct Approach {
    double leastApart = 1e9;  ///< m, between centres
    double arrived = -1;      ///< s
};
Approach approach(const Scenario& scenario, std::size_t robot, std::size_t other, int seconds) {
    WorldState state = scenario.initialState();
    Approach result;
    for (int tick = 0; tick < seconds * ticksPerSecond; ++tick) {
        run(scenario, state, 1);
        const Point at = position(state.robots[robot].pose);
        result.leastApart = std::min(result.leastApart, distance(at, position(state.robots[other].pose)));
        if (result.arrived < 0 && distance(at, position(state.objects[0].pose)) < 0.6)
            result.arrived = tick / double(ticksPerSecond);
    }
    return result;
}

const auto stands = std::make_shared<const Told>(Command{});

TEST(TeamPlayer, WhoGoesDrivesRoundARobotThatStandsInTheWay) {
    for (const double aside : {-0.1, 0.0, 0.2}) {
        const Scenario scenario = field({{1.5, 2.5, 0}}, {6, 2.5}, {}, asTheyAre)
                                      .robot(discRobot(0.2), {3.5, 2.5 + aside, 0}, stands, ideal())
                                      .scenario();
        const Approach of = approach(scenario, 0, 1, 25);
        EXPECT_GT(of.leastApart, 0.42) << aside << ": they do not touch";
        // 3.9 m at 0.4 m/s, and the way round.
        EXPECT_GT(of.arrived, 3.9 / 0.4) << aside;
        EXPECT_LT(of.arrived, 3.9 / 0.4 + 6) << aside;
    }
}

TEST(TeamPlayer, WhoIsAtTheBallIsNotDrivenRound) {
    const Scenario scenario = field({{1.5, 2.5, 0}}, {4, 2.5}, {}, asTheyAre)
                                  .robot(discRobot(0.2), {4.35, 2.6, 0}, stands, ideal())
                                  .scenario();
    const double arrived = approach(scenario, 0, 1, 15).arrived;
    EXPECT_GT(arrived, 1.9 / 0.4);
    EXPECT_LT(arrived, 1.9 / 0.4 + 3);
}

TEST(TeamPlayer, WhoGoesDoesNotWaitAsideWhileAnotherRobotIsAtABallAtAWall) {
    const Point ball{4.5, 0.13};
    const auto beside = [&](std::shared_ptr<const Controller> controller) {
        SmallWorld world(walledField(9, 5));
        world.robot(guideRobot({}), {3, 2.5, -0.8}, std::move(controller), lateDrive());
        world.robot(discRobot(0.2), {ball.x + 0.4, 0.3, 0}, stands, ideal());
        world.object(ballType(), {ball.x, ball.y, 0});
        return world.scenario();
    };
    TeamPlayer::Options player = options(1);
    EXPECT_GT(approach(beside(std::make_shared<const TeamPlayer>(player)), 0, 1, 20).arrived, 0);
    EXPECT_LT(approach(beside(std::make_shared<const ChaseBall>(player.chase)), 0, 1, 20).arrived, 0)
        << "alone it waits for the other one";
}

TEST(TeamPlayer, ThoseThatSupportLeaveABallAtAWallAlone) {
    for (const Point& ball : {Point{4.5, 0.13}, Point{8.87, 1}, Point{0.13, 4}, Point{6, 4.87}}) {
        const std::vector<Pose> starts{{ball.x > 4.5 ? ball.x - 0.7 : ball.x + 0.7, std::clamp(ball.y, 0.6, 4.4), 0},
                                       {4.5, 2.5, 1},
                                       {std::clamp(ball.x, 1.5, 7.5), ball.y < 2.5 ? 1.2 : 3.8, 3}};
        const Scenario scenario = field(starts, ball, {}, [](std::size_t, TeamPlayer::Options& own) {
                                      own.choose = TeamPlayer::Choose::fixed;
                                      own.goes = 0;
                                  }).scenario();
        WorldState state = scenario.initialState();
        run(scenario, state, 15 * ticksPerSecond);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_GT(distance(position(state.robots[i].pose), position(state.objects[0].pose)), 0.9)
                << "player " << i + 1 << ", ball at " << ball.x << ", " << ball.y;
    }
}

}  // namespace
}  // namespace mrose
