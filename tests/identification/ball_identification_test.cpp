#include "identification/ball_identification.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/small_world.h"
#include "support/units.h"
#include "synthetic/ball_play.h"
#include "synthetic/field_landmarks.h"

namespace mrose {
namespace {

using testing::HasSubstr;

/// What the world's ball, floor, walls and robot are made with.
struct Truth {
    double rolling = 0.5, sliding = 0.25, inertia = 0.5, wall = 0.75, robot = 0.55;
};

class KickingOnce final : public Controller {
public:
    explicit KickingOnce(double power) : power_(power) {}
    void decide(const Observation& observation, std::span<std::byte> /*memory*/, Decision& decision) const override {
        if (observation.time >= 600 * ms && observation.time < 700 * ms) decision.kicks.push_back({0, power_});
    }

private:
    double power_;
};

RobotType kicker(double restitution) {
    RobotType type = discRobot(0.225, 2000);  // nothing moves it
    type.surface = {0.2, restitution};
    type.manipulators = {{.name = "kicker",
                          .position = {0.225, 0},
                          .speed = 4,
                          .reach = 0.05,
                          .width = 0.2,
                          .recharge = 10'000 * ms,
                          .deadTime = 100 * ms}};
    return type;
}

/// Tracks the world's ball every tick with 2 mm of noise, and says where the robots stand.
Trajectory playedInTheWorld(const Scenario& scenario, int ticks, std::uint64_t seed) {
    Trajectory trajectory;
    trajectory.name = std::to_string(seed);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    for (int k = 0; k < ticks; ++k) {
        const Nanoseconds time = k * 20 * ms;
        const NoisePair noise = normalPair({seed, k, 0, 0});
        const Point place = position(state.objects[0].pose);
        trajectory.ball.push_back({time, {place.x + 0.002 * noise.first, place.y + 0.002 * noise.second}});
        trajectory.poses.push_back({time, state.robots[0].pose});
        step(scenario, state, buffers);
    }
    return trajectory;
}

ObjectType ballOf(const Truth& truth) {
    ObjectType ball = ballType();
    ball.surface = {0.2, std::min(truth.wall, truth.robot)};
    ball.inertia = truth.inertia;
    return ball;
}

/// A dozen kicks in a walled room: at its walls, and one in two at a second robot.
Log kicksInTheWorld(const Truth& truth, std::uint64_t seed) {
    Log log;
    log.robots.push_back({"kicker", {}, {}});
    log.robots.push_back({"other", {}, {}});
    for (int i = 0; i < 12; ++i) {
        const UniformDraws draw(NoiseKey{seed, i, 0, 1});
        Environment room = walledField(5, 4, {0.2, truth.wall});
        room.floor.rollingDeceleration = truth.rolling;
        room.floor.slidingFriction = truth.sliding;
        SmallWorld world(std::move(room));
        const Pose start{2.5, 2, 6.283 * draw[0]};
        world.robot(kicker(truth.robot), start, std::make_shared<const KickingOnce>(0.5 + 0.5 * draw[1]), ideal());
        const bool second = i % 2 == 0;
        const Pose other = start * Pose{1.3, 0.02, 1};
        if (second) world.robot(kicker(truth.robot), other, std::make_shared<const KickingOnce>(0), ideal());
        world.object(ballOf(truth), start * Pose{0.225 + 0.11 + 0.02, 0.03, 0});
        Trajectory played = playedInTheWorld(world.scenario(), 220, 100 * seed + static_cast<std::uint64_t>(i));
        played.kicks = {{600 * ms, 1}};
        const Nanoseconds later = i * 10'000 * ms;
        for (StampedBall& ball : played.ball) ball.time += later;
        for (StampedPose& pose : played.poses) pose.time += later;
        for (StampedKick& kick : played.kicks) kick.time += later;
        if (second) {
            Trajectory there;
            there.name = played.name;
            for (const StampedPose& pose : played.poses) there.poses.push_back({pose.time, other});
            log.robots[1].trajectories.push_back(std::move(there));
        }
        log.robots[0].trajectories.push_back(std::move(played));
    }
    return log;
}

std::vector<ConvexPiece> wallsOfTheRoom() {
    std::vector<ConvexPiece> pieces;
    for (const Obstacle& obstacle : walledField(5, 4).obstacles)
        pieces.insert(pieces.end(), obstacle.shape.pieces.begin(), obstacle.shape.pieces.end());
    return pieces;
}

/// How far estimates are off what is true, in their standard errors, of several seeds.
struct Deviations {
    int known = 0, within2 = 0;
    double sum = 0;
    void add(const BallEstimate& estimate, double truth) {
        if (!estimate.identified) return;
        const double z = (estimate.value - truth) / estimate.error;
        ++known;
        within2 += std::abs(z) < 2 ? 1 : 0;
        sum += z;
    }
    void expect(int runs, const char* what) const {
        EXPECT_EQ(known, runs) << what;
        EXPECT_GE(within2, runs - 2) << what << ", mean " << sum / known;
        EXPECT_LT(std::abs(sum / known), 1.2) << what;
    }
};

TEST(BallIdentification, FindsWhatTheWorldsBallWasMadeWithWithinItsErrors) {
    const Truth truth;
    constexpr int runs = 10;
    Deviations rolling, sliding, inertia, walls, robots;
    for (int seed = 1; seed <= runs; ++seed) {
        const auto found = identifyBall(kicksInTheWorld(truth, static_cast<std::uint64_t>(seed)),
                                        {.obstacles = wallsOfTheRoom(), .headOn = 0.5});
        ASSERT_TRUE(found) << found.error().message();
        rolling.add(found->rollingDeceleration, truth.rolling);
        sliding.add(found->slidingFriction, truth.sliding);
        inertia.add(found->inertia, truth.inertia);
        walls.add(found->wallRestitution, truth.wall);
        robots.add(found->robotRestitution, truth.robot);
        EXPECT_NEAR(found->noise, 0.002, 2e-4);
        EXPECT_LT(found->rollingDeceleration.error, 0.02);
        EXPECT_LT(found->slidingFriction.error, 0.01);
    }
    rolling.expect(runs, "rolling");
    sliding.expect(runs, "sliding");
    inertia.expect(runs, "inertia");
    walls.expect(runs, "walls");
    robots.expect(runs, "robots");
}

/// The reference ball is of another class: what its log says in the mean must be what it did in the mean.
TEST(BallIdentification, FindsWhatTheReferenceBallDidInTheMean) {
    Log log;
    log.robots.push_back({"reference", {}, {}});
    double walls = 0, approaches = 0;
    std::vector<BallTruth::Bounce> bounces;
    for (int i = 0; i < 90; ++i) {
        BallRun run =
            playBall(i % 3 == 0 ? BallPlay::kicks : BallPlay::throws, 6, 50 + static_cast<std::uint64_t>(i), i);
        Trajectory& trajectory = log.robots[0].trajectories.emplace_back();
        trajectory.poses = run.robot.tracked;
        trajectory.ball = run.ball;
        trajectory.kicks = run.kicks;
        const Nanoseconds later = i * 10'000 * ms;
        for (StampedPose& pose : trajectory.poses) pose.time += later;
        for (StampedBall& ball : trajectory.ball) ball.time += later;
        for (StampedKick& kick : trajectory.kicks) kick.time += later;
        for (const BallTruth::Bounce& bounce : run.truth.bounces)
            if (!bounce.robot && bounce.approach > 0.5) walls += bounce.parting, approaches += bounce.approach;
    }
    std::vector<ConvexPiece> pieces;
    for (const Obstacle& obstacle : walledField(syntheticFieldLength, syntheticFieldWidth).obstacles)
        pieces.insert(pieces.end(), obstacle.shape.pieces.begin(), obstacle.shape.pieces.end());
    const auto found = identifyBall(log, {.obstacles = pieces});
    ASSERT_TRUE(found) << found.error().message();
    EXPECT_LE(found->unexplained, 2u);
    const BallEstimate& wall = found->wallRestitution;
    ASSERT_TRUE(wall.identified);
    EXPECT_NEAR(wall.value, walls / approaches, 3 * wall.error + 0.01);
    // The floor's deceleration at 0.8 m/s, and a quarter of it for each m/s.
    const BallEstimate& rolling = found->rollingDeceleration;
    ASSERT_TRUE(rolling.identified);
    EXPECT_NEAR(rolling.value, 0.4 * (0.8 + 0.25 * found->rollingSpeed), 3 * rolling.error + 0.01);
    EXPECT_GT(rolling.spread, 0.02) << "patches and the pile";
    // Its friction is 0.3 to 0.375, and it rolls against the floor while it slides.
    ASSERT_TRUE(found->slidingFriction.identified);
    EXPECT_GT(found->slidingFriction.value, 0.3);
    EXPECT_LT(found->slidingFriction.value, 0.375 + 0.8 / 9.81);
}

TEST(BallIdentification, SaysWhatIsMissingAndDoesTheRest) {
    Log log = kicksInTheWorld({}, 3);
    for (RobotLog& robot : log.robots)
        for (Trajectory& trajectory : robot.trajectories) trajectory.kicks.clear();
    const auto noKicks = identifyBall(log, {.obstacles = wallsOfTheRoom()});
    ASSERT_TRUE(noKicks);
    EXPECT_FALSE(noKicks->inertia.identified);
    EXPECT_THAT(noKicks->inertia.reason, HasSubstr("no kicks"));
    EXPECT_TRUE(noKicks->slidingFriction.identified);
    for (RobotLog& robot : log.robots)
        for (Trajectory& trajectory : robot.trajectories) trajectory.poses.clear();
    const auto noRobots = identifyBall(log, {.obstacles = wallsOfTheRoom()});
    ASSERT_TRUE(noRobots);
    EXPECT_FALSE(noRobots->robotRestitution.identified);
    EXPECT_THAT(noRobots->robotRestitution.reason, HasSubstr("only 0 events; it needs 3"));
    EXPECT_GT(noRobots->unexplained, 0u) << "touches of the second robot";
    log.robots.resize(1);
    log.robots[0].trajectories.resize(1);
    log.robots[0].trajectories[0].ball.resize(25);
    const auto still = identifyBall(log);
    ASSERT_FALSE(still);
    EXPECT_THAT(still.error().cause, HasSubstr("holds 25 positions of a ball, but no stretch in which it moves"));
    log.robots[0].trajectories[0].ball.clear();
    EXPECT_THAT(identifyBall(log).error().cause, HasSubstr("holds no ball (columns ball_x and ball_y)"));
}

TEST(BallIdentification, WithoutAMapOnlyHeadOnTouchesCount) {
    const Log log = kicksInTheWorld({}, 4);
    const auto with = identifyBall(log, {.obstacles = wallsOfTheRoom()}), without = identifyBall(log);
    ASSERT_TRUE(with && without);
    EXPECT_EQ(with->touches, without->touches);
    EXPECT_GT(without->oblique, with->oblique);
    EXPECT_LT(without->wallRestitution.events, with->wallRestitution.events);
}

TEST(MeanOfEvents, CountsTheSpreadBetweenThemAndLeavesOutliersOut) {
    const std::vector<double> errors(6, 0.1);
    const BallEstimate alike = meanOfEvents(std::vector{1.0, 1.1, 0.9, 1.05, 0.95, 1.0}, errors, 3);
    EXPECT_NEAR(alike.value, 1, 1e-12);
    EXPECT_NEAR(alike.error, 0.1 / std::sqrt(6.0), 1e-12);
    EXPECT_EQ(alike.spread, 0);
    // Variance 1.4 about the mean, by n - 1; less 0.01 of each.
    const BallEstimate apart = meanOfEvents(std::vector{-1.0, 1.0, -1.5, 1.5, -0.5, 0.5}, errors, 3);
    EXPECT_NEAR(apart.spread, std::sqrt(1.4 - 0.01), 1e-9);
    EXPECT_NEAR(apart.error, std::sqrt(1.4 / 6), 1e-9);
    const BallEstimate wild = meanOfEvents(std::vector{1.0, 1.1, 0.9, 1.05, 0.95, 50.0}, errors, 3);
    EXPECT_EQ(wild.events, 5u);
    EXPECT_NEAR(wild.value, 1, 1e-12);
    EXPECT_FALSE(meanOfEvents(std::vector{1.0, 2.0}, std::vector{0.1, 0.1}, 3).identified);
}

}  // namespace
}  // namespace mrose
