#include "behaviour/team_belief.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "control/controller.h"
#include "geometry/point.h"

namespace mrose {
namespace {

constexpr Nanoseconds second = nanosecondsPerSecond;

TeamWord word(const Pose& pose, const Point& ball, double ballVariance) {
    return {.pose = pose,
            .velocity = {},
            .poseVariance = 0,
            .ball = ball,
            .ballVelocity = {},
            .ballVariance = ballVariance,
            .ballSeen = 0,
            .others = {{{TeamWord::nowhere, 0}, {TeamWord::nowhere, 0}}},
            .cost = 1,
            .role = TeamWord::supports};
}

ReceivedMessage received(const TeamWord& said, Nanoseconds sent) {
    const RadioMessage message = RadioMessage::of(said, TeamWord::kind);
    return {.sent = sent, .from = 3, .kind = message.kind, .size = message.size, .bytes = message.bytes};
}

OwnBelief knowingItself(double variance) {
    OwnBelief self{};
    self.known = 1;
    self.positionVariance = variance;
    return self;
}

BallTrack seen(const Point& place, double variance) {
    BallTrack ball{};
    ball.position = place;
    ball.variance = variance;
    ball.known = 1;
    return ball;
}

TEST(TeamBelief, KeepsTheNewestWhateverTheOrder) {
    TeamBelief team{};
    EXPECT_FALSE(team.mates[2].isHeard(0));
    EXPECT_TRUE(team.hear(received(word({1, 0, 0}, {}, 0), 2 * second), 2));
    EXPECT_FALSE(team.hear(received(word({9, 0, 0}, {}, 0), second), 2)) << "overtaken";
    EXPECT_EQ(team.mates[2].word.pose.x, 1);
    EXPECT_TRUE(team.mates[2].isHeard(3 * second));
    EXPECT_FALSE(team.mates[2].isHeard(3 * second + 1));
}

TEST(TeamBelief, PassesOverWhatIsNoWordOfFiniteNumbers) {
    TeamBelief team{};
    ReceivedMessage other = received(word({1, 0, 0}, {}, 0), second);
    other.kind = 7;
    EXPECT_FALSE(team.hear(other, 0));
    other = received(word({1, 0, 0}, {}, 0), second);
    other.size = 8;
    EXPECT_FALSE(team.hear(other, 0));
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        EXPECT_FALSE(team.hear(received(word({bad, 0, 0}, {}, 0), second), 0));
    TeamWord cannotGo = word({1, 0, 0}, {}, 0);
    cannotGo.cost = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(team.hear(received(cannotGo, second), 0));
}

TEST(TeamBelief, CarriesMatesOnForHalfASecond) {
    TeamBelief team{};
    TeamWord driving = word({1, 2, 0}, {}, 0);
    driving.velocity = {0.4, 0};
    team.hear(received(driving, second), 0);
    EXPECT_NEAR(team.mates[0].at(second + second / 4).x, 1.1, 1e-12);
    EXPECT_NEAR(team.mates[0].at(3 * second).x, 1.2, 1e-12);
    EXPECT_EQ(team.mates[0].at(second / 2).x, 1);
}

TEST(TeamBelief, ABallThatAMateSeesIsKnownAndAsUnsureAsAllThatWentIntoIt) {
    TeamBelief team{};
    EXPECT_EQ(team.ball({}, knowingItself(0.01), {}, second).known, 0);
    TeamWord said = word({}, {2, 1}, 0.04);
    said.poseVariance = 0.02;
    team.hear(received(said, second), 1);
    const BallBelief ball = team.ball({}, knowingItself(0.01), {}, second);
    ASSERT_EQ(ball.known, 1);
    EXPECT_EQ(ball.position, (Point{2, 1}));
    EXPECT_NEAR(ball.variance, 0.07, 1e-12);
    // It is forgotten with the mate.
    EXPECT_EQ(team.ball({}, knowingItself(0.01), {}, 2 * second + 1).known, 0);
}

/// Two measurements weighted by their inverse variances.
TEST(TeamBelief, SightingsThatAgreeAreWeighted) {
    TeamBelief team{};
    team.hear(received(word({}, {2.2, 0}, 0.03), second), 1);
    const BallBelief ball = team.ball(seen({2, 0}, 0.01), knowingItself(0), {}, second);
    EXPECT_NEAR(ball.position.x, (2 / 0.01 + 2.2 / 0.03) / (1 / 0.01 + 1 / 0.03), 1e-12);
    EXPECT_NEAR(ball.variance, 1 / (1 / 0.01 + 1 / 0.03), 1e-12);
    // It rolls on while nobody says anything.
    TeamWord rolling = word({}, {0, 0}, 0.01);
    rolling.ballVelocity = {1, 0};
    TeamBelief others{};
    others.hear(received(rolling, second), 1);
    EXPECT_NEAR(others.ball({}, knowingItself(0), {}, second + second / 2).position.x, 0.5 - 0.4 * 0.25 / 2, 1e-9);
    const FloorPlan wall({*ConvexPiece::polygon({{0.4, -1}, {0.5, -1}, {0.5, 1}, {0.4, 1}})});
    EXPECT_NEAR(others.ball({}, knowingItself(0), {&wall, 0.1}, 2 * second).position.x, 0.3, 0.001);
}

/// After a goal it lies elsewhere, and one of them has not seen that.
TEST(TeamBelief, OfBallsInTwoPlacesTheSurerOneIsIt) {
    TeamBelief team{};
    team.hear(received(word({}, {0, 0}, 0.002), second), 1);
    const BallBelief ball = team.ball(seen({4, 1}, 0.1), knowingItself(0.001), {}, second);
    EXPECT_EQ(ball.position, (Point{0, 0}));
}

}  // namespace
}  // namespace mrose
