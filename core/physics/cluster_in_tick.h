#pragma once

#include <vector>

#include "physics/islands.h"
#include "physics/meeting.h"

namespace mrose {

/// A cluster on its way through a tick: what the stages of it hand to each other.
struct ClusterInTick {
    const ContactTick* tick = nullptr;
    const ContactCluster* cluster = nullptr;
    std::vector<MovingBody> bodies;
    std::vector<Meeting> meetings;
    Islands islands;

    MovingPiece pieceA(const Meeting& m) const { return {&bodies[m.a], m.outlineA}; }
    MovingPiece pieceB(const Meeting& m) const { return {m.grounded() ? nullptr : &bodies[m.b], m.outlineB}; }

    /// m/s, of the second from the first at a point.
    double partingAt(const Meeting& meeting, const Point& where, const Point& axis) const {
        const Point other = meeting.grounded() ? Point{} : bodies[meeting.b].velocityAt(where);
        return dot(other - bodies[meeting.a].velocityAt(where), axis);
    }

    /// Makes the islands of a meeting's bodies one.
    void join(const Meeting& meeting) {
        if (!meeting.grounded()) islands.join(meeting.a, meeting.b);
    }
};

}  // namespace mrose
