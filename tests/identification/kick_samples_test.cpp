#include "identification/kick_samples.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/units.h"
#include "synthetic/ball_play.h"

namespace mrose {
namespace {

/// Kicks of the reference kicker, one in each trajectory, and what is true of them.
struct PlayedKicks {
    Log log;
    std::vector<BallTruth::Departure> truth;
};
PlayedKicks playedKicks(int count) {
    PlayedKicks played;
    played.log.robots.push_back({"reference", {}, {}});
    for (int i = 0; i < count; ++i) {
        BallRun run = playBall(BallPlay::kicks, 4, 900 + static_cast<std::uint64_t>(i), i);
        Trajectory& trajectory = played.log.robots[0].trajectories.emplace_back();
        trajectory.commands = run.commands;
        trajectory.poses = run.robot.tracked;
        trajectory.kicks = run.kicks;
        trajectory.ball = run.ball;
        played.truth.push_back(run.truth.departures.at(0));
    }
    return played;
}

TEST(KickSamples, SayWhatTheReferenceKickerDid) {
    const PlayedKicks played = playedKicks(60);
    const KickSamples samples = kickSamples({played.log});
    EXPECT_EQ(samples.commanded, 60u);
    EXPECT_GE(samples.kicks.size() + samples.far, 57u);
    EXPECT_LE(samples.unclear, 3u);
    // In the order of the trajectories, some of which are left out: each has its nearest power.
    double delayOff = 0, speedOff = 0, turnOff = 0, placeOff = 0, hits = 0;
    std::size_t next = 0;
    for (const KickSample& kick : samples.kicks) {
        const auto powerOf = [&](std::size_t i) { return played.log.robots[0].trajectories[i].kicks[0].power; };
        while (next < 60 && powerOf(next) != kick.state.power) ++next;
        ASSERT_LT(next, 60u);
        const BallTruth::Departure& truth = played.truth[next];
        EXPECT_EQ(kick.hit, truth.hit) << next;
        placeOff += std::pow(length(kick.state.ball_B - truth.place), 2);
        EXPECT_NEAR(kick.state.robot.v, truth.robot.v, 0.03);
        if (!kick.hit) continue;
        ++hits;
        delayOff += std::pow(kick.delay - truth.delay, 2);
        speedOff += std::pow(kick.speed - length(truth.velocity), 2);
        turnOff += std::pow(wrapAngle(kick.direction - direction(truth.velocity)), 2);
    }
    EXPECT_GE(hits, 35);
    EXPECT_LT(std::sqrt(delayOff / hits), 0.005);
    EXPECT_LT(std::sqrt(speedOff / hits), 0.12);
    EXPECT_LT(std::sqrt(turnOff / hits), 0.02);
    EXPECT_LT(std::sqrt(placeOff / static_cast<double>(samples.kicks.size())), 0.006);
}

TEST(KickSamples, WhatIsNotTrackedOrMovesBeforeIsLeftOutAndCounted) {
    PlayedKicks played = playedKicks(4);
    std::vector<Trajectory>& trajectories = played.log.robots[0].trajectories;
    trajectories[0].ball.clear();
    trajectories[1].poses.clear();
    for (StampedBall& ball : trajectories[2].ball) ball.place.x += 0.3 * toSeconds(ball.time);
    const KickSamples samples = kickSamples({played.log});
    EXPECT_EQ(samples.commanded, 4u);
    EXPECT_EQ(samples.unseen, 2u);
    EXPECT_EQ(samples.unclear, 1u);
    EXPECT_LE(samples.kicks.size(), 1u);
}

}  // namespace
}  // namespace mrose
