#include "physics/first_touches.h"

#include <algorithm>

#include "physics/kept_impulses.h"

namespace mrose {
namespace {

/// Whether the two pressed on each other before, with the other one first then: so they do not bounce, but the search
/// for impulses begins without those, whose spots had other names.
bool leantTurned(const ContactImpulse& key, std::span<const ContactImpulse> before) {
    return key.bodyB != noBody && !impulsesOf({key.bodyB, key.pieceB, key.bodyA, key.pieceA}, before).empty();
}

/// Whether two that do not touch yet will in this tick, and will not bounce: then they may press from its start on, by
/// so much that they just touch when it ends.
bool comesToPress(const ClusterInTick& cluster, const Meeting& meeting) {
    const double duration = cluster.tick->duration;
    const double approach = -cluster.partingAt(meeting, meeting.gap.at, meeting.gap.axis);
    if (approach >= bounceThreshold && !meeting.leant) return false;
    if (meeting.gap.distance - touchDistance >= approach * duration) return false;
    return timeOfTouch(cluster.pieceA(meeting), cluster.pieceB(meeting), meeting.gap, 0, duration) != never;
}

void lookAtStart(ClusterInTick& cluster, Meeting& meeting, std::span<const ContactImpulse> before) {
    const ContactImpulse key = keyOf(*cluster.cluster, meeting);
    meeting.kept = impulsesOf(key, before);
    meeting.leant = !meeting.kept.empty() || leantTurned(key, before);
    meeting.far = !meeting.leant && tooFar(cluster.pieceA(meeting), cluster.pieceB(meeting), 0, cluster.tick->duration);
    if (meeting.far) return;
    const ConvexPiece& a = cluster.bodies[meeting.a].body->pieces[meeting.pieceA];
    const ConvexPiece& b =
        meeting.grounded() ? meeting.outlineB->outline : cluster.bodies[meeting.b].body->pieces[meeting.pieceB];
    meeting.gap = gapBetween(a, b);
    if (meeting.gap.distance > touchDistance + touchSlack && !comesToPress(cluster, meeting)) return;
    meeting.touch = findTouch(a, b, meeting.gap);
    meeting.touches = true;
}

}  // namespace

void findFirstTouches(ClusterInTick& cluster, std::span<const ContactImpulse> before,
                      std::vector<std::uint32_t>& starting) {
    cluster.islands.separate(cluster.bodies.size());
    for (Meeting& meeting : cluster.meetings) {
        lookAtStart(cluster, meeting, before);
        if (meeting.touches) cluster.join(meeting);
    }
    starting.clear();
    for (const Meeting& meeting : cluster.meetings)
        if (meeting.touches) starting.push_back(cluster.islands.of(meeting.a));
    std::sort(starting.begin(), starting.end());
    starting.erase(std::unique(starting.begin(), starting.end()), starting.end());
}

}  // namespace mrose
