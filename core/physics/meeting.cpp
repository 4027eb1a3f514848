#include "physics/meeting.h"

#include <algorithm>
#include <cmath>

#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

/// The paper's random factor.
void vary(const ContactTick& tick, std::uint32_t first, std::uint32_t second, Meeting& meeting) {
    if (tick.randomFactor == 0) return;
    const std::uint32_t body = std::min(first, second), other = std::max(first, second);
    const auto factor = [&](NoiseChannel what) {
        const std::uint32_t channel = channelOf(what, other == noBody ? 0 : other + 1);
        return 1 + tick.randomFactor * (2 * uniformNoise({tick.seed, tick.tick, body, channel}) - 1);
    };
    meeting.restitution = std::min(1.0, meeting.restitution * factor(NoiseChannel::restitution));
    meeting.friction *= factor(NoiseChannel::contactFriction);
}

using Piece = CollisionShape::Piece;

}  // namespace

void findMeetings(const ContactTick& tick, const ContactCluster& cluster, std::vector<Meeting>& meetings) {
    meetings.clear();
    const auto piecesOf = [&](std::uint32_t body) -> const std::vector<Piece>& {
        return cluster.bodies[body].shape->pieces;
    };
    Meeting meeting;
    for (const auto& [a, b] : cluster.pairs) {
        const ContactBody &first = cluster.bodies[a], &second = cluster.bodies[b];
        meeting.a = a;
        meeting.b = b;
        meeting.friction = std::sqrt(first.friction * second.friction);
        meeting.restitution = std::max(first.restitution, second.restitution);
        vary(tick, first.body, second.body, meeting);
        for (meeting.pieceA = 0; meeting.pieceA < piecesOf(a).size(); ++meeting.pieceA)
            for (meeting.pieceB = 0; meeting.pieceB < piecesOf(b).size(); ++meeting.pieceB) {
                meeting.outlineA = &piecesOf(a)[meeting.pieceA];
                meeting.outlineB = &piecesOf(b)[meeting.pieceB];
                meetings.push_back(meeting);
            }
    }
    for (const ObstaclePair& pair : cluster.obstacles) {
        const ContactBody& body = cluster.bodies[pair.body];
        meeting.a = pair.body;
        meeting.b = noBody;
        meeting.pieceB = pair.piece;
        meeting.outlineB = &tick.obstacleShape->pieces[pair.piece];
        meeting.friction = std::sqrt(body.friction * pair.friction);
        meeting.restitution = std::max(body.restitution, pair.restitution);
        vary(tick, body.body, noBody, meeting);
        for (meeting.pieceA = 0; meeting.pieceA < piecesOf(pair.body).size(); ++meeting.pieceA) {
            meeting.outlineA = &piecesOf(pair.body)[meeting.pieceA];
            meetings.push_back(meeting);
        }
    }
}

ContactImpulse keyOf(const ContactCluster& cluster, const Meeting& meeting) {
    return {cluster.bodies[meeting.a].body, meeting.pieceA,
            meeting.grounded() ? noBody : cluster.bodies[meeting.b].body, meeting.pieceB};
}

}  // namespace mrose
