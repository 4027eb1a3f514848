#include "physics/outcomes.h"

#include <algorithm>

namespace mrose {
namespace {

// Slower than this a pressing pair does not part, m/s.
constexpr double partingSpeed = 1e-3;

bool parting(const ClusterInTick& cluster, const Meeting& meeting) {
    for (int i = 0; i < meeting.touch.count; ++i)
        if (cluster.partingAt(meeting, meeting.touch.spots[i].position, meeting.touch.normal) <= partingSpeed)
            return false;
    return true;
}

}  // namespace

ContactOutcome outcomeOf(MovingBody& body, double duration) {
    ContactOutcome outcome;
    outcome.moved = body.pushed || body.displaced;
    if (!outcome.moved) return outcome;
    body.advance(duration);
    outcome.pose = {body.frame.origin.x, body.frame.origin.y, body.heading};
    const Point velocity = body.velocityAt(body.frame.origin);
    outcome.velocity_W = {velocity.x, velocity.y, body.rotation};
    outcome.travel = body.travel;
    return outcome;
}

bool pressesOn(const ClusterInTick& cluster, const Meeting& meeting) {
    return meeting.state == Meeting::State::pressing && meeting.impulse > 0 && !parting(cluster, meeting);
}

bool worthReporting(const Meeting& meeting) {
    return meeting.impulse > 0 ||
           (meeting.state == Meeting::State::pressing && meeting.gap.distance <= touchDistance + touchSlack);
}

ContactReport reportOf(const ContactCluster& cluster, const Meeting& meeting) {
    ContactReport report;
    report.bodyA = cluster.bodies[meeting.a].body;
    report.bodyB = meeting.grounded() ? noBody : cluster.bodies[meeting.b].body;
    report.obstacle = meeting.grounded() ? meeting.pieceB : 0;
    report.normal = meeting.touch.normal;
    if (report.bodyA > report.bodyB) {
        std::swap(report.bodyA, report.bodyB);
        report.normal = -1 * report.normal;
    }
    Point sum;
    for (int i = 0; i < meeting.touch.count; ++i) sum = sum + meeting.touch.spots[i].position;
    report.position = (1.0 / std::max(1, meeting.touch.count)) * sum;
    report.impulse = meeting.impulse;
    return report;
}

}  // namespace mrose
