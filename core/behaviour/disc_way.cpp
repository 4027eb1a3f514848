#include "behaviour/disc_way.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrose {
namespace {

constexpr double straightFrom = 1000;  // m, radius of an arc

double squareOf(double x) { return x * x; }

}  // namespace

double straightWay(std::span<const Point> points, const Point& direction, double radius, double most) {
    double way = most;
    for (const Point& point : points) {
        const double along = dot(direction, point), aside = cross(direction, point);
        if (along <= 0 || along >= way + radius || std::abs(aside) >= radius) continue;
        way = std::min(way, std::max(0.0, along - std::sqrt(squareOf(radius) - squareOf(aside))));
    }
    return way;
}

/// All is mirrored to an arc forwards and to the left, about (0, turn). The disc touches a point at `far` from there
/// when the angle between both is that of a triangle with the sides turn, far and radius. No way to a point is shorter
/// than the straight one.
double arcWay(std::span<const Point> points, const Velocity& velocity, double radius, double most) {
    if (velocity.v == 0) return most;
    const double forwards = velocity.v > 0 ? 1 : -1;
    if (std::abs(velocity.v) >= straightFrom * std::abs(velocity.w))
        return straightWay(points, {forwards, 0}, radius, most);
    const double turn = std::abs(velocity.v / velocity.w), side = velocity.v * velocity.w > 0 ? 1 : -1;
    const double innermost = squareOf(std::max(0.0, turn - radius)), outermost = squareOf(turn + radius);
    double way = most;
    for (const Point& point : points) {
        if (dot(point, point) >= squareOf(way + radius)) continue;
        const Point from{forwards * point.x, side * point.y - turn};
        const double squared = dot(from, from);
        if (squared <= innermost || squared >= outermost) continue;
        const double far = std::sqrt(squared);
        const double half = far > 0 ? (squareOf(turn) + squared - squareOf(radius)) / (2 * turn * far) : -1;
        const double within = arcCosine(std::clamp(half, -1.0, 1.0)), at = arcTangent(from.x, -from.y);
        const bool touches = std::abs(at) < within;
        const double angle = touches && at > 0 ? 0 : at > 0 ? at - within : at - within + 2 * std::numbers::pi;
        way = std::min(way, angle * turn);
    }
    return way;
}

}  // namespace mrose
