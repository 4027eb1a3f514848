#include "physics/contact_plan.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "physics/prepared_shape.h"

namespace mrose {
namespace {

// Box2D limits a step to 2 units and a quarter turn.
constexpr double longestMove = 1.5, largestTurn = 1.2;
constexpr int velocityIterations = 8;
// A light body squeezed between heavy ones needs more: each iteration leaves heavy / (heavy + light) of the error.
constexpr int squeezedIterations = 40;
// A body of less than this share of another one's mass is light beside it.
constexpr double light = 0.25, heldShare = 0.5;
// A body that moves farther than this share of its reach in a tick needs continuous collision, with other moving ones
// too.
constexpr double farMove = 0.1;
// Continuous collision takes a quarter of a step's time. Bodies that only lean on what they touched before do without,
// and those that would come less deep (m) into something new, which the solver presses out again.
constexpr double shallow = 0.002;

auto tied(const ContactImpulse& c) { return std::tie(c.bodyA, c.pieceA, c.bodyB, c.pieceB, c.feature); }

bool touchedBefore(std::uint32_t body, std::uint32_t piece, std::span<const ContactImpulse> before) {
    // The solver puts either of the two first, by their kinds of shape.
    auto at = std::lower_bound(before.begin(), before.end(), ContactImpulse{body, 0, 0, 0, 0, 0, 0}, keyLess);
    for (; at != before.end() && at->bodyA == body; ++at)
        if (at->bodyB == noBody && at->pieceB == piece) return true;
    at = std::lower_bound(before.begin(), before.end(), ContactImpulse{noBody, piece, body, 0, 0, 0, 0}, keyLess);
    return at != before.end() && at->bodyA == noBody && at->pieceA == piece && at->bodyB == body;
}

bool tunnels(const ContactTask& task, const ContactBody& body, const ContactCluster& cluster,
             std::span<const ContactImpulse> before) {
    const std::vector<ConvexPiece>& pieces = body.shape->prepared().pieces;
    for (std::size_t k = cluster.firstObstacle; k < cluster.lastObstacle; ++k) {
        const std::uint32_t piece = task.obstacles[k].piece;
        if (touchedBefore(body.body, piece, before)) continue;
        const ConvexPiece& obstacle = task.obstacleShape->prepared().pieces[piece];
        const Placement planned(body.planned);
        for (const ConvexPiece& own : pieces)
            if (mayBeNearer(placed(own, planned), obstacle, -shallow)) return true;
    }
    return false;
}

bool squeezed(std::uint32_t body, std::span<const ContactImpulse> before) {
    std::optional<std::pair<std::uint32_t, std::uint32_t>> partner;
    for (const ContactImpulse& c : before) {
        if (c.bodyA != body && c.bodyB != body) continue;
        const auto other = c.bodyA == body ? std::pair{c.bodyB, c.bodyB == noBody ? c.pieceB : 0}
                                           : std::pair{c.bodyA, c.bodyA == noBody ? c.pieceA : 0};
        if (partner && *partner != other) return true;
        partner = other;
    }
    return false;
}

}  // namespace

bool keyLess(const ContactImpulse& a, const ContactImpulse& b) { return tied(a) < tied(b); }

PlannedMove plannedMove(const ContactBody& body) {
    Point way = position(body.planned) - position(body.pose);
    if (!(body.centre == Point{}))
        way = way + Placement(body.planned).rotate(body.centre) - Placement(body.pose).rotate(body.centre);
    return {way, length(way) > farMove * body.reach};
}

SolverEffort effortFor(const ContactTask& task, std::span<const ContactCluster> clusters,
                       std::span<const PlannedMove> moves, std::span<const ContactImpulse> before) {
    SolverEffort effort;
    double steps = 1;
    const PlannedMove* move = moves.data();
    for (const ContactCluster& cluster : clusters)
        for (std::size_t i = cluster.firstBody; i < cluster.lastBody; ++i, ++move) {
            const ContactBody& body = task.bodies[i];
            const double turn = std::abs(body.planned.heading - body.pose.heading);
            steps = std::max({steps, length(move->way) * unitsPerMetre / longestMove, turn / largestTurn});
            effort.continuous = effort.continuous || move->fast || tunnels(task, body, cluster, before);
        }
    effort.steps = static_cast<int>(std::ceil(std::min(steps, 1000.0)));
    effort.stepLength = static_cast<float>(task.duration / effort.steps);
    const bool squeeze = std::any_of(clusters.begin(), clusters.end(), [](const ContactCluster& c) {
        return c.members() >= 3 && c.lightest < light * c.heaviest;
    });
    effort.iterations = squeeze ? squeezedIterations : velocityIterations;
    return effort;
}

double heldMassFactor(const ContactBody& body, const ContactCluster& cluster, std::span<const ContactImpulse> before) {
    const bool held = body.mass < light * cluster.heaviest && squeezed(body.body, before);
    return held ? heldShare * cluster.heaviest / body.mass : 1;
}

}  // namespace mrose
