#include "behaviour/ball_track.h"

#include <optional>

#include <gtest/gtest.h>

#include "behaviour/small_field.h"
#include "support/observation_parts.h"

namespace mrose {
namespace {

/// A robot that stands at the origin, knows that, and is shown the ball every 100 ms.
class TrackingWatcher {
public:
    const BallTrack& see(std::optional<Point> ball) {
        ObservationParts observation;
        observation.time = observation.selfMeasured = instant_++ * 100'000'000LL;
        observation.localised = true;
        if (ball) observation.objects = {{0, *ball, observation.time}};
        motion_.observe(observation);
        self_.update(observation, motion_);
        track_.update(observation, motion_, self_, {});
        return track_;
    }

private:
    std::int64_t instant_ = 0;
    MotionMemory motion_{};
    OwnBelief self_{};
    BallTrack track_{};
};

/// As a camera measures a range: off by a share that grows with it.
Point measuredAt(double range, std::int64_t which) {
    return {range * (1 + (0.03 + 0.02 * range) * normalNoise({61, which, 0, 0})), 0};
}

TEST(BallTrack, OfAFarBallItIsRightInTheMeanAndSaysHowSureItIs) {
    const double range = 5.5;
    double sum = 0, squares = 0, said = 0, speed = 0;
    constexpr int runs = 200;
    for (std::int64_t i = 0; i < runs; ++i) {
        TrackingWatcher watcher;
        for (std::int64_t k = 0; k < 19; ++k) watcher.see(measuredAt(range, 100 * i + k));
        const BallTrack track = watcher.see(measuredAt(range, 100 * i + 19));
        const double off = track.position.x - range;
        sum += off;
        squares += off * off;
        said += track.variance;
        speed += length(track.velocity);
    }
    EXPECT_LT(std::abs(sum) / runs, 0.1);
    EXPECT_LT(squares / runs, 2 * said / runs);
    EXPECT_GT(squares / runs, 0.2 * said / runs);
    EXPECT_LT(speed / runs, 0.4) << "m/s of a ball that lies";
}

TEST(BallTrack, FollowsARollingBall) {
    TrackingWatcher watcher;
    const double v = 1.5, deceleration = 0.4;
    const auto at = [&](double t) { return Point{0.5 + v * t - deceleration * t * t / 2, 0.3}; };
    for (int i = 0; i < 15; ++i) watcher.see(at(0.1 * i));
    const BallTrack& track = watcher.see(at(1.5));
    EXPECT_LT(distance(track.position, at(1.5)), 0.06);
    EXPECT_NEAR(track.velocity.x, v - 1.5 * deceleration, 0.15);
}

TEST(BallTrack, SeesSoonThatABallWasKicked) {
    TrackingWatcher watcher;
    for (int i = 0; i < 30; ++i) watcher.see(Point{1, 0});
    for (int i = 1; i <= 5; ++i) watcher.see(Point{1 + 0.25 * i, 0});
    const BallTrack& track = watcher.see(Point{2.5, 0});
    EXPECT_NEAR(track.position.x, 2.5, 0.3) << "as far as it rolls in 0.12 s";
    EXPECT_GT(track.velocity.x, 1.5);
}

TEST(BallTrack, IsLessSureTheLongerItHasNotSeenItAndForgetsIt) {
    TrackingWatcher watcher;
    watcher.see(Point{-1, 0.2});
    double before = 0;
    for (int i = 0; i < 60; ++i) {
        const BallTrack& track = watcher.see(std::nullopt);
        ASSERT_EQ(track.known, 1) << i;
        EXPECT_GT(track.variance, before);
        before = track.variance;
    }
    for (int i = 0; i < 2; ++i) watcher.see(std::nullopt);
    EXPECT_EQ(watcher.see(std::nullopt).known, 0);
}

TEST(BallTrack, IsLostSoonWhereItShouldBeSeen) {
    TrackingWatcher watcher;
    watcher.see(Point{1, 0.1});
    for (int i = 0; i < 5; ++i) EXPECT_EQ(watcher.see(std::nullopt).known, 1);
    for (int i = 0; i < 5; ++i) watcher.see(std::nullopt);
    EXPECT_EQ(watcher.see(std::nullopt).known, 0);
}

}  // namespace
}  // namespace mrose
