#include "physics/meeting.h"

#include <algorithm>
#include <cmath>

#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

/// Friction and restitution of two bodies.
struct Surfaces {
    double friction, restitution;
};

/// By the paper's random factor.
Surfaces varied(const ContactTick& tick, std::uint32_t first, std::uint32_t second, const Surfaces& nominal) {
    if (tick.randomFactor == 0) return nominal;
    const std::uint32_t body = std::min(first, second), other = std::max(first, second);
    const auto factor = [&](NoiseChannel what) {
        const std::uint32_t channel = channelOf(what, other == noBody ? 0 : other + 1);
        return 1 + tick.randomFactor * (2 * uniformNoise({tick.seed, tick.tick, body, channel}) - 1);
    };
    return {nominal.friction * factor(NoiseChannel::contactFriction),
            std::min(1.0, nominal.restitution * factor(NoiseChannel::restitution))};
}

void add(const Surfaces& surfaces, std::vector<Meeting>& meetings, std::uint32_t a, std::uint32_t pieceA,
         const CollisionShape::Piece& outlineA, std::uint32_t b, std::uint32_t pieceB,
         const CollisionShape::Piece& outlineB) {
    Meeting& meeting = meetings.emplace_back();
    meeting.a = a;
    meeting.b = b;
    meeting.pieceA = pieceA;
    meeting.pieceB = pieceB;
    meeting.outlineA = &outlineA;
    meeting.outlineB = &outlineB;
    meeting.friction = surfaces.friction;
    meeting.restitution = surfaces.restitution;
}

}  // namespace

void findMeetings(const ContactTick& tick, const ContactCluster& cluster, std::vector<Meeting>& meetings) {
    meetings.clear();
    for (const auto& [a, b] : cluster.pairs) {
        const ContactBody &first = cluster.bodies[a], &second = cluster.bodies[b];
        const Surfaces surfaces =
            varied(tick, first.body, second.body,
                   {std::sqrt(first.friction * second.friction), std::max(first.restitution, second.restitution)});
        const auto &own = first.shape->pieces, &theirs = second.shape->pieces;
        for (std::uint32_t i = 0; i < own.size(); ++i)
            for (std::uint32_t j = 0; j < theirs.size(); ++j) add(surfaces, meetings, a, i, own[i], b, j, theirs[j]);
    }
    for (const ObstaclePair& pair : cluster.obstacles) {
        const ContactBody& body = cluster.bodies[pair.body];
        const Surfaces surfaces =
            varied(tick, body.body, noBody,
                   {std::sqrt(body.friction * pair.friction), std::max(body.restitution, pair.restitution)});
        const CollisionShape::Piece& obstacle = tick.obstacleShape->pieces[pair.piece];
        for (std::uint32_t i = 0; i < body.shape->pieces.size(); ++i)
            add(surfaces, meetings, pair.body, i, body.shape->pieces[i], noBody, pair.piece, obstacle);
    }
}

ContactImpulse keyOf(const ContactCluster& cluster, const Meeting& meeting) {
    return {cluster.bodies[meeting.a].body, meeting.pieceA,
            meeting.grounded() ? noBody : cluster.bodies[meeting.b].body, meeting.pieceB};
}

}  // namespace mrose
