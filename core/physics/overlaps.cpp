#include "physics/overlaps.h"

#include <algorithm>

namespace mrose {
namespace {

constexpr double bearable = 2.5e-4;  // m nearer than touching
constexpr int sweeps = 16;
constexpr double share = 0.5;  // of the overlap in a sweep: all of it would throw neighbours to and fro

double inverseMassAlong(const MovingBody& body, const Point& arm, const Point& axis) {
    const double lever = cross(arm, axis);
    return body.inverseMass + body.inverseInertia * lever * lever;
}

/// Whether it had to be pressed out.
bool pushApart(MovingBody& a, MovingBody* b, const Meeting& meeting) {
    const ConvexPiece one = placed(meeting.outlineA->outline, a.frame);
    const ConvexPiece other = b != nullptr ? placed(meeting.outlineB->outline, b->frame) : meeting.outlineB->outline;
    const double reach = one.reach + other.reach + touchDistance;
    const Point between = other.centre - one.centre;
    if (dot(between, between) > reach * reach) return false;
    const Gap gap = gapBetween(one, other);
    if (gap.distance >= touchDistance - bearable) return false;
    const Touch touch = findTouch(one, other, gap);
    const Point centreOfA = a.centre, centreOfB = b != nullptr ? b->centre : Point{};
    Point moveA, moveB;
    double turnA = 0, turnB = 0;
    for (int i = 0; i < touch.count; ++i) {
        const double sunk = touchDistance - touch.spots[i].distance;
        if (sunk <= bearable) continue;
        const Point armOfA = touch.spots[i].position - centreOfA, armOfB = touch.spots[i].position - centreOfB;
        double inverseMass = inverseMassAlong(a, armOfA, touch.normal);
        if (b != nullptr) inverseMass += inverseMassAlong(*b, armOfB, touch.normal);
        const Point push = (share / touch.count * sunk / inverseMass) * touch.normal;
        moveA = moveA - a.inverseMass * push;
        turnA -= a.inverseInertia * cross(armOfA, push);
        if (b == nullptr) continue;
        moveB = moveB + b->inverseMass * push;
        turnB += b->inverseInertia * cross(armOfB, push);
    }
    a.displace(moveA, turnA);
    if (b != nullptr) b->displace(moveB, turnB);
    return true;
}

}  // namespace

void pressOut(std::span<MovingBody> bodies, std::span<Meeting> meetings, double time) {
    for (int i = 0; i < sweeps; ++i) {
        bool any = false;
        for (Meeting& meeting : meetings) {
            MovingBody& a = bodies[meeting.a];
            MovingBody* const b = meeting.grounded() ? nullptr : &bodies[meeting.b];
            const bool displaced = a.displaced || (b != nullptr && b->displaced);
            const bool sunk = meeting.state == Meeting::State::pressing ? meeting.atEnd < touchDistance - bearable
                                                                        : meeting.bounces > 0;
            if (!displaced && !sunk) continue;
            a.advance(time);
            if (b != nullptr) b->advance(time);
            if (pushApart(a, b, meeting)) any = true;
        }
        if (!any) return;
    }
}

}  // namespace mrose
