#include "behaviour/team_belief.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "geometry/point.h"

namespace mrose {
namespace {

constexpr double longestGuess = 0.5;  // s: how far a mate's motion is carried on
constexpr double agreeing = 3;        // standard deviations between two beliefs of one ball
constexpr double leastVariance = 1e-6;

bool isFinite(const TeamWord& word) {
    const double sum = word.pose.x + word.pose.y + word.pose.heading + word.velocity.v + word.velocity.w +
                       word.poseVariance + word.ball.x + word.ball.y + word.ballVelocity.x + word.ballVelocity.y +
                       word.ballVariance + word.others[0].x + word.others[0].y + word.others[1].x + word.others[1].y;
    return std::isfinite(sum) && !std::isnan(word.cost);
}

/// A ball as someone believes it, now.
struct Belief {
    Point position, velocity;
    double variance = 0;
    Nanoseconds seen = 0;
};

Belief beliefOf(const TeamBelief::Mate& mate, double ownVariance, const BallFloor& floor, Nanoseconds now) {
    const TeamWord& word = mate.word;
    const BallBelief told{.position = word.ball,
                          .velocity = word.ballVelocity,
                          .variance = word.ballVariance,
                          .time = mate.told,
                          .seen = word.ballSeen,
                          .missing = 0,
                          .known = 1};
    const BallBelief then = told.after(toSeconds(now - mate.told), floor);
    // It lies to the mate as seen, and to the world as the mate does: off by what both of us are.
    return {then.position, then.velocity, then.variance + word.poseVariance + ownVariance, word.ballSeen};
}

}  // namespace

Pose TeamBelief::Mate::at(Nanoseconds now) const {
    const double since = std::clamp(toSeconds(now - told), 0.0, longestGuess);
    return word.pose * exp({since * word.velocity.v, 0, since * word.velocity.w});
}

bool TeamBelief::hear(const ReceivedMessage& message, std::size_t place) {
    Mate& mate = mates[place];
    if (message.kind != TeamWord::kind || message.size != sizeof(TeamWord)) return false;
    if (mate.known != 0 && message.sent <= mate.told) return false;
    TeamWord word;
    std::memcpy(&word, message.bytes.data(), sizeof word);
    if (!isFinite(word)) return false;
    mate = {word, message.sent, 1};
    return true;
}

BallBelief TeamBelief::ball(const BallTrack& own, const OwnBelief& self, const BallFloor& floor,
                            Nanoseconds now) const {
    std::array<Belief, most + 1> all;
    std::size_t count = 0;
    if (own.known != 0) all[count++] = {own.position, own.velocity, own.variance, own.seen};
    for (const Mate& mate : mates)
        if (mate.isHeard(now) && mate.word.ballVariance > 0)
            all[count++] = beliefOf(mate, self.positionVariance, floor, now);
    BallBelief ball{
        .position = own.position, .velocity = own.velocity, .variance = own.variance, .time = now, .seen = own.seen};
    if (count == 0) return ball;
    const std::span<const Belief> beliefs = std::span(all).first(count);
    const Belief& surest =
        *std::ranges::min_element(beliefs, [](const Belief& a, const Belief& b) { return a.variance < b.variance; });
    double sum = 0;
    Point position, velocity;
    ball.seen = surest.seen;
    for (const Belief& belief : beliefs) {
        const Point off = belief.position - surest.position;
        if (dot(off, off) > agreeing * agreeing * (belief.variance + surest.variance)) continue;
        const double weight = 1 / std::max(leastVariance, belief.variance);
        sum += weight;
        position = position + weight * belief.position;
        velocity = velocity + weight * belief.velocity;
        ball.seen = std::max(ball.seen, belief.seen);
    }
    ball.position = (1 / sum) * position;
    ball.velocity = (1 / sum) * velocity;
    ball.variance = 1 / sum;
    ball.missing = 0;
    ball.known = 1;
    return ball;
}

}  // namespace mrose
