#include "physics/time_of_touch.h"

#include <algorithm>
#include <cmath>

#include "physics/touch.h"

namespace mrose {
namespace {

// Of two that are as near as touching and do not approach, m that they may do so before they are looked at again.
constexpr double look = 5e-5;
// Turning pieces may touch unnoticed by as much within a stretch that they begin and end apart, m.
constexpr double graze = 3e-4;
// Slower than this nothing approaches, m/s.
constexpr double still = 1e-9;

Placement frameAt(const MovingPiece& p, double time) { return p.body != nullptr ? p.body->frameAt(time) : Placement(); }

/// How far a piece reaches along an axis of its own frame.
double support(const MovingPiece& p, const Point& axis) {
    const ConvexPiece& outline = p.piece->outline;
    double most = dot(axis, outline.corners[0]);
    for (std::size_t i = 1; i < outline.count; ++i) most = std::max(most, dot(axis, outline.corners[i]));
    return most + outline.radius;
}

/// A gap's axis, which turns with the edge that it is a normal of.
class TurningAxis {
public:
    TurningAxis(const MovingPiece& a, const MovingPiece& b, const Gap& gap, double time) : a_(a), b_(b), gap_(gap) {
        if (gap.edge == Gap::Edge::ofFirst) axis_ = frameAt(a, time).rotateBack(gap.axis);
        if (gap.edge == Gap::Edge::ofSecond) axis_ = frameAt(b, time).rotateBack(gap.axis);
    }
    double gapAt(double time) const {
        const Placement first = frameAt(a_, time), second = frameAt(b_, time);
        const Point axis = gap_.edge == Gap::Edge::ofFirst    ? first.rotate(axis_)
                           : gap_.edge == Gap::Edge::ofSecond ? second.rotate(axis_)
                                                              : gap_.axis;
        return dot(axis, second.origin - first.origin) - support(a_, first.rotateBack(axis)) -
               support(b_, second.rotateBack(-1 * axis));
    }

private:
    const MovingPiece &a_, &b_;
    const Gap& gap_;
    Point axis_;
};

/// m/s at most, of a point of it by its turning.
double turningOf(const MovingPiece& p) { return p.body != nullptr ? std::abs(p.body->rotation) * p.piece->turning : 0; }

Point velocityOf(const MovingPiece& p) { return p.body != nullptr ? p.body->velocity : Point{}; }

Point velocityAt(const MovingPiece& p, const Point& point, double time) {
    if (p.body == nullptr) return {};
    const Point arm = point - position(p.body->poseAt(time));
    return {p.body->velocity.x - p.body->rotation * arm.y, p.body->velocity.y + p.body->rotation * arm.x};
}

Point middleAt(const MovingPiece& p, double time) {
    const Point& centre = p.piece->outline.centre;
    return p.body != nullptr ? p.body->frameAt(time).place(centre) : centre;
}

/// m/s2 at most, of the gap along the axis.
double bendOf(const MovingPiece& a, const MovingPiece& b, const Gap& gap) {
    const auto rotation = [](const MovingPiece& p) { return p.body != nullptr ? std::abs(p.body->rotation) : 0.0; };
    const double own = rotation(a) * turningOf(a) + rotation(b) * turningOf(b);
    if (gap.edge == Gap::Edge::none) return own;
    const MovingPiece &edge = gap.edge == Gap::Edge::ofFirst ? a : b, &corner = gap.edge == Gap::Edge::ofFirst ? b : a;
    if (rotation(edge) == 0) return own;
    const Point way = corner.body != nullptr ? corner.body->centre - edge.body->centre : gap.at - edge.body->centre;
    const double far = length(way) + (corner.body != nullptr ? corner.piece->turning : corner.piece->outline.reach);
    const double speed = length(velocityOf(a) - velocityOf(b)) + turningOf(corner);
    return rotation(edge) * (rotation(edge) * far + 2 * speed) + rotation(corner) * turningOf(corner);
}

}  // namespace

ConvexPiece placedAt(const MovingPiece& p, double time) {
    return p.body != nullptr ? placed(p.piece->outline, p.body->frameAt(time)) : p.piece->outline;
}

Gap gapAt(const MovingPiece& a, const MovingPiece& b, double time) {
    if (b.body == nullptr) return gapBetween(placedAt(a, time), b.piece->outline);
    return gapBetween(placedAt(a, time), placedAt(b, time));
}

bool tooFar(const MovingPiece& a, const MovingPiece& b, double from, double until) {
    const Point between = middleAt(b, from) - middleAt(a, from);
    const double speed = length(velocityOf(b) - velocityOf(a)) + turningOf(a) + turningOf(b);
    const double reach = a.piece->outline.reach + b.piece->outline.reach + touchDistance + speed * (until - from);
    return dot(between, between) > reach * reach;
}

double timeOfTouch(const MovingPiece& a, const MovingPiece& b, const Gap& now, double from, double until) {
    const Point relative = velocityOf(b) - velocityOf(a);
    const double turning = turningOf(a) + turningOf(b);
    Gap gap = now;
    for (double time = from;;) {
        double least = touchDistance;  // that the gap must not get below on the next stretch
        if (gap.distance <= touchDistance + touchSlack) {
            const Point slip = velocityAt(b, gap.at, time) - velocityAt(a, gap.at, time);
            if (dot(slip, gap.axis) < -still) return time;
            least = gap.distance - look;
        }
        const double closing = turning - dot(relative, gap.axis);
        if (closing <= 0) return never;
        const double surely = (gap.distance - least) / closing;
        double stretch = until - time;
        if (stretch > surely) {
            const TurningAxis axis(a, b, gap, time);
            const double bend = bendOf(a, b, gap);
            stretch = std::min(stretch, std::sqrt(8 * graze / std::max(bend, still)));
            while (stretch > surely) {
                const double then = axis.gapAt(time + stretch);
                if (then >= least) break;
                const double aim = least + touchSlack / 2;
                stretch *= std::clamp((gap.distance - aim) / (gap.distance - then), 0.05, 0.95);
            }
        }
        time += std::max(stretch, surely);
        if (time >= until) return never;
        gap = gapAt(a, b, time);
    }
}

double distanceLater(const MovingPiece& a, const MovingPiece& b, const Gap& now, double from, double later,
                     double enough) {
    const double along = TurningAxis(a, b, now, from).gapAt(later);
    return along >= enough ? along : gapAt(a, b, later).distance;
}

}  // namespace mrose
