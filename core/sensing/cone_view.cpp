#include "sensing/cone_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mrose {
namespace {

constexpr double noEcho = std::numeric_limits<double>::infinity();
constexpr double seam = 1e-9;  // rad: between neighbouring edges nothing looks through

}  // namespace

double ConeView::Arc::range(double direction) const {
    const auto [s, c] = sineCosine(direction - facing);
    if (radius == 0) return c > 0 ? distance / c : noEcho;
    const double aside = distance * s;
    return distance * c - std::sqrt(std::max(0.0, radius * radius - aside * aside));
}

double ConeView::Arc::incidence(double direction) const {
    const auto [s, c] = sineCosine(direction - facing);
    if (radius == 0) return c;
    const double sine = std::min(1.0, std::abs(distance * s / radius));
    return std::sqrt((1 - sine) * (1 + sine));
}

double ConeView::Arc::reflects(double limit) const {
    if (radius == 0) return limit;
    return limit >= std::numbers::pi / 2 ? limit : arcSine(std::min(1.0, radius / distance * sineCosine(limit).sine));
}

/// The parts of it that are within the cone: what reaches round behind may be there twice.
void ConeView::add(Arc arc, double halfWidth) {
    constexpr double turn = 2 * std::numbers::pi;
    for (const double turned : {0.0, turn, -turn}) {
        Arc part = arc;
        part.least = std::max(arc.least + turned, -halfWidth);
        part.most = std::min(arc.most + turned, halfWidth);
        part.facing = arc.facing + turned;
        if (part.least <= part.most) arcs_.push_back(part);
    }
}

void ConeView::look(const Outlines& outlines, const Pose& element, double halfWidth) {
    arcs_.clear();
    const Placement eye(element);
    const auto [s, c] = sineCosine(halfWidth);
    const double edgeCosine = c, edgeSine = s;
    // Beyond one of the cone's edges with all of it: by how far a point is to the left, or to the right, of that edge.
    const auto beyond = [&](double y, const Point& p) { return y * edgeCosine - p.x * edgeSine; };
    const auto addEdge = [&](const Point& left, const Point& right) {
        const double height = cross(right, left);
        if (!(height > 0)) return;  // turned away
        if (beyond(left.y, left) > 0 && beyond(right.y, right) > 0) return;
        if (beyond(-left.y, left) > 0 && beyond(-right.y, right) > 0) return;
        const Point along = left - right;
        Arc arc;
        arc.distance = height / length(along);
        arc.least = direction(right);
        arc.most = arc.least + arcTangent(height, dot(right, left));
        // By how much the foot of the perpendicular to the edge's line is off its right end.
        arc.facing = arc.least + arcTangent(-dot(right, along), height);
        add(arc, halfWidth);
    };
    for (const Outlines::Polygon& polygon : outlines.polygons()) {
        Point left = eye.placeBack(outlines.corners()[polygon.end - 1]);
        for (const Point& corner : outlines.corners().subspan(polygon.first, polygon.end - polygon.first)) {
            const Point right = eye.placeBack(corner);
            addEdge(left, right);
            left = right;
        }
    }
    for (const Outlines::Circle& circle : outlines.circles()) {
        const Point centre = eye.placeBack(circle.centre);
        const double away = length(centre);
        if (!(away > circle.radius)) continue;
        if (beyond(std::abs(centre.y), centre) > circle.radius) continue;
        Arc arc;
        arc.radius = circle.radius;
        arc.distance = away;
        arc.facing = direction(centre);
        const double half = arcSine(circle.radius / away);
        arc.least = arc.facing - half;
        arc.most = arc.facing + half;
        add(arc, halfWidth);
    }
}

ConeView::Hit ConeView::along(double direction) const {
    Hit hit{noEcho, 0};
    for (const Arc& arc : arcs_) {
        if (direction < arc.least - seam || direction > arc.most + seam) continue;
        if (const double range = arc.range(direction); range < hit.range) hit = {range, arc.incidence(direction)};
    }
    return hit;
}

/// Whether the arc is hidden in a direction in which both are.
bool ConeView::hides(const Arc& other, const Arc& arc, double direction) {
    constexpr double apart = 1e-9;  // m: neighbouring edges meet at their corner
    return other.range(direction) < arc.range(direction) - apart;
}

/// The first direction from `start` on, upwards or downwards by `step`'s sign, in which nothing hides the arc.
double ConeView::visibleFrom(const Arc& arc, double start, double step) const {
    for (bool moved = true; moved;) {
        moved = false;
        for (const Arc& other : arcs_) {
            const double least = std::max(arc.least, other.least), most = std::min(arc.most, other.most);
            if (&other == &arc || !(least < most) || start < least - seam || start > most + seam) continue;
            double hidden = std::clamp(start, least, most);
            if (!hides(other, arc, hidden)) continue;
            const double end = step > 0 ? most : least;
            double seen = end + step * 2 * seam;
            if (!hides(other, arc, end)) {  // they cross between, as walls do in a corner
                seen = end;
                while (std::abs(seen - hidden) > seam) {
                    const double middle = 0.5 * (hidden + seen);
                    (hides(other, arc, middle) ? hidden : seen) = middle;
                }
            }
            start = seen;
            moved = true;
        }
    }
    return start;
}

double ConeView::nearestEcho(double limit) const {
    double nearest = noEcho;
    for (const Arc& arc : arcs_) {
        const double reach = arc.reflects(limit);
        const double least = std::max(arc.least, arc.facing - reach), most = std::min(arc.most, arc.facing + reach);
        if (least > most) continue;
        const double best = std::clamp(arc.facing, least, most);
        if (arc.range(best) >= nearest) continue;
        for (const double step : {1.0, -1.0}) {
            const double direction = visibleFrom(arc, best, step);
            if (direction >= least && direction <= most) nearest = std::min(nearest, arc.range(direction));
        }
    }
    return nearest;
}

}  // namespace mrose
