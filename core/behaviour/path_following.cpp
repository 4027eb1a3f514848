#include "behaviour/path_following.h"

#include <algorithm>
#include <limits>

namespace mrose {
namespace {

constexpr double pursued = 0.35;     // m, how far ahead the point is that it drives to
constexpr double slowsWithin = 0.5;  // m, of the end

}  // namespace

double progressAlong(std::span<const Point> points, const Point& place, double was, double most) {
    double along = 0, best = was, least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 1; i < points.size() && along <= was + most; ++i) {
        const Point line = points[i] - points[i - 1];
        const double far = length(line);
        if (far > 0 && along + far >= was) {
            const double from = std::max(0.0, was - along), to = std::min(far, was + most - along);
            const double on = std::clamp(dot(place - points[i - 1], line) / far, from, std::max(from, to));
            if (const double off = distance(place, points[i - 1] + (on / far) * line); off < least) {
                least = off;
                best = along + on;
            }
        }
        along += far;
    }
    return best;
}

Point pointAt(std::span<const Point> points, double along) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double far = distance(points[i - 1], points[i]);
        if (along < far) return points[i - 1] + (std::max(0.0, along) / far) * (points[i] - points[i - 1]);
        along -= far;
    }
    return points.back();
}

std::vector<Point> pointsAfter(std::span<const Point> points, double along) {
    std::vector<Point> rest;
    double sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        sum += distance(points[i - 1], points[i]);
        if (sum > along) rest.push_back(points[i]);
    }
    if (rest.empty()) rest.push_back(points.back());
    return rest;
}

Command followPath(std::span<const Point> points, const Pose& ahead, double progress, double end,
                   const DriveLimits& limits) {
    const Point target = pointAt(points, std::min(end, progress + pursued));
    const Point line = target - position(ahead);
    if (end - progress < slowsWithin) return driveToPose(ahead, {target.x, target.y, direction(line)}, limits, false);
    return driveTowards(Placement(ahead).rotateBack(line), limits);
}

}  // namespace mrose
