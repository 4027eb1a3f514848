#include "sensing/floor_lines.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

constexpr double lineRounding = 1e-9;

/// From a point to a line of some length, by one over that squared.
double squaredDistance(const Point& point, const Point& from, const Point& along, double perSquare) {
    const Point to = point - from;
    const Point off = to - std::clamp(dot(to, along) * perSquare, 0.0, 1.0) * along;
    return dot(off, off);
}

}  // namespace

void FloorLines::find(const Environment& environment, const Placement& frame, double nearest, double farthest) {
    nearest_ = nearest - lineRounding;
    farthest_ = farthest + lineRounding;
    strokes_.clear();
    rings_.clear();
    for (const Marking& marking : environment.markings) {
        if (marking.radius > 0) {
            const Point centre = frame.placeBack(marking.centre);
            const double away = length(centre), reach = marking.width / 2;
            if (std::abs(away - marking.radius) - reach <= farthest_ && away + marking.radius + reach >= nearest_)
                rings_.push_back({centre, marking.radius, reach});
            continue;
        }
        const std::size_t count = marking.points.size();
        for (std::size_t i = 0; i + (marking.closed ? 0 : 1) < count; ++i)
            addStroke(frame.placeBack(marking.points[i]), frame.placeBack(marking.points[(i + 1) % count]),
                      marking.width);
    }
}

void FloorLines::addStroke(const Point& from, const Point& to, double width) {
    const Point along = to - from;
    const double perSquare = 1 / dot(along, along), reach = width / 2;
    const double least = std::sqrt(squaredDistance({}, from, along, perSquare)) - reach;
    const double most = std::max(length(from), length(to)) + reach;
    if (least <= farthest_ && most >= nearest_) strokes_.push_back({from, along, perSquare, reach * reach});
}

bool FloorLines::hold(const Point& point) const {
    for (const Stroke& stroke : strokes_)
        if (squaredDistance(point, stroke.from, stroke.along, stroke.perSquare) <= stroke.squaredReach) return true;
    for (const Ring& ring : rings_)
        if (std::abs(distance(point, ring.centre) - ring.radius) <= ring.reach) return true;
    return false;
}

}  // namespace mrose
