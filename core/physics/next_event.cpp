#include "physics/next_event.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

// A pair that presses and would sink in deeper is looked at again before it has by so much, m, and so often in a tick.
constexpr double deepest = 5e-4, deep = 2.5e-4;
constexpr int mostSinkings = 64;
// And when the two have turned by so much against each other, rad.
constexpr double largestTurn = 0.2;
// Not before so much of the time until then, so that time goes on.
constexpr double leastShare = 0.05;

/// Where they touch they do not approach; they sink in by turning and sliding round each other, with time's square.
void findSinking(ClusterInTick& cluster, Meeting& meeting, double time) {
    const double end = cluster.tick->duration;
    const double now = std::min(meeting.gap.distance, touchDistance);
    const double turning =
        std::abs(cluster.bodies[meeting.a].rotation - (meeting.grounded() ? 0 : cluster.bodies[meeting.b].rotation));
    const double until = turning * (end - time) > largestTurn ? time + largestTurn / turning : end;
    meeting.atEnd =
        distanceLater(cluster.pieceA(meeting), cluster.pieceB(meeting), meeting.gap, time, until, now - deep);
    const double sinks = now - meeting.atEnd;
    if (meeting.sinkings >= mostSinkings) return;
    if (sinks > deepest)
        meeting.next = time + (until - time) * std::max(leastShare, std::sqrt(deep / sinks));
    else if (until < end)
        meeting.next = until;
}

}  // namespace

void findNextEvent(ClusterInTick& cluster, Meeting& meeting, double time) {
    const double end = cluster.tick->duration;
    const bool apart = meeting.state == Meeting::State::apart;
    const MovingPiece a = cluster.pieceA(meeting), b = cluster.pieceB(meeting);
    meeting.next = never;
    if (apart && tooFar(a, b, time, end)) return;
    cluster.bodies[meeting.a].know(end);
    if (!meeting.grounded()) cluster.bodies[meeting.b].know(end);
    if (!apart) {
        findSinking(cluster, meeting, time);
        return;
    }
    const bool known = time == 0 && !meeting.far;
    meeting.next = timeOfTouch(a, b, known ? meeting.gap : gapAt(a, b, time), time, end);
}

}  // namespace mrose
