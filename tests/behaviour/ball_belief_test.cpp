#include "behaviour/ball_belief.h"

#include <functional>

#include <gtest/gtest.h>

#include "behaviour/small_field.h"
#include "support/observation_parts.h"

namespace mrose {
namespace {

/// A robot that stands at a pose, knows that, and is shown the ball every 100 ms.
class Watcher {
public:
    explicit Watcher(const Pose& pose, const BallFloor& floor = {}) : pose_(pose), floor_(floor) {}

    const BallBelief& see(std::optional<Point> ball, const Point& error = {}) {
        ObservationParts observation;
        observation.time = observation.selfMeasured = instant_++ * 100'000'000LL;
        observation.localised = true;
        observation.self = pose_;
        if (ball) observation.objects = {{0, Placement(pose_).placeBack(*ball) + error, observation.time}};
        motion_.observe(observation);
        self_.update(observation, motion_);
        ball_.update(observation, motion_, self_, floor_);
        return ball_;
    }

private:
    Pose pose_;
    BallFloor floor_;
    std::int64_t instant_ = 0;
    MotionMemory motion_{};
    OwnBelief self_{};
    BallBelief ball_{};
};

TEST(BallBelief, FollowsARollingBallAndForeseesItsWay) {
    Watcher watcher({0, 0, 0.2});
    const double v = 1.5, deceleration = 0.4;
    const auto at = [&](double t) { return Point{0.5 + v * t - deceleration * t * t / 2, 0.3}; };
    for (int i = 0; i < 10; ++i) watcher.see(at(0.1 * i));
    const BallBelief ball = watcher.see(at(1));
    EXPECT_LT(distance(ball.position, at(1)), 0.06);
    EXPECT_NEAR(ball.velocity.x, v - deceleration, 0.2);
    EXPECT_LT(distance(ball.after(0.5, {}).position, at(1.5)), 0.15);
    // It comes to rest after v / deceleration seconds.
    EXPECT_EQ(ball.after(20, {}).position, ball.after(30, {}).position);
}

/// The robot turns while its camera's images arrive 0.2 s late.
TEST(BallBelief, PlacesLateSightingsByThePoseOfThen) {
    const Point ball{2, 1};
    const double w = 0.8;
    MotionMemory motion{};
    OwnBelief self{};
    BallBelief belief{};
    for (int i = 0; i < 15; ++i) {
        ObservationParts observation;
        observation.time = observation.selfMeasured = i * 100'000'000LL;
        observation.localised = true;
        observation.self = {0, 0, 0.1 * i * w};
        observation.velocity = {0, w};
        const Placement then({0, 0, (0.1 * i - 0.2) * w});
        if (i >= 2) observation.objects = {{0, then.placeBack(ball), observation.time - 200'000'000}};
        motion.observe(observation);
        self.update(observation, motion);
        belief.update(observation, motion, self, {});
        EXPECT_TRUE(i < 2 || distance(belief.position, ball) < 1e-9) << i;
    }
}

TEST(BallBelief, TrustsNearSightingsMore) {
    double errors[2] = {};
    for (const int near : {0, 1}) {
        Watcher watcher({0, 0, 0});
        const double range = near == 1 ? 0.5 : 4;
        for (std::int64_t i = 0; i < 200; ++i) {
            const double error = 0.05 * normalNoise({52, i, 0, 0});
            const BallBelief& ball = watcher.see(Point{range, 0}, {error, 0});
            if (i > 50) errors[near] += std::abs(ball.position.x - range);
        }
    }
    EXPECT_LT(errors[0], 0.5 * errors[1]);
}

/// It rolls behind the robot, at a wall that it would else be believed to have passed.
TEST(BallBelief, DoesNotBelieveABallBehindWalls) {
    const FloorPlan walls({*ConvexPiece::polygon({{-3, -5}, {-2, -5}, {-2, 5}, {-3, 5}})});
    Watcher watcher({0, 0, 0.1}, {&walls, 0.11});
    for (int i = 0; i < 10; ++i) watcher.see(Point{-0.8 - 0.1 * i, 0.2});
    for (int i = 0; i < 30; ++i) EXPECT_GT(watcher.see(std::nullopt).position.x, -1.9) << i;
    EXPECT_LT(watcher.see(std::nullopt).position.x, -1.88);
}

TEST(BallBelief, StaysForAWhileWhereItCannotBeSeen) {
    Watcher watcher({0, 0, 0});
    EXPECT_EQ(watcher.see(std::nullopt).known, 0);
    const Point behind{-1, 0.2};
    watcher.see(behind);
    for (int i = 0; i < 50; ++i) EXPECT_EQ(watcher.see(std::nullopt).known, 1) << i;
    EXPECT_LT(distance(watcher.see(std::nullopt).position, behind), 1e-9);
    for (int i = 0; i < 20; ++i) watcher.see(std::nullopt);
    EXPECT_EQ(watcher.see(std::nullopt).known, 0);
}

TEST(BallBelief, IsLostSoonWhereItShouldBeSeen) {
    Watcher watcher({0, 0, 0});
    watcher.see(Point{1, 0.1});
    for (int i = 0; i < 5; ++i) EXPECT_EQ(watcher.see(std::nullopt).known, 1);
    for (int i = 0; i < 5; ++i) watcher.see(std::nullopt);
    EXPECT_EQ(watcher.see(std::nullopt).known, 0);
    EXPECT_EQ(watcher.see(Point{2, 1}).position, (Point{2, 1}));
}

}  // namespace
}  // namespace mrose
