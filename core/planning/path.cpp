#include "planning/path.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

constexpr double chordAngle = 0.03;  // rad: what an arc's distance is measured by
constexpr double noLength = 1e-9;    // m

/// `share` of an arc from its beginning.
Point onArc(const PathPart& arc, double share) {
    return arc.centre + Placement({0, 0, share * arc.angle}).rotate(arc.from - arc.centre);
}

double distanceOf(const PathPart& part, const DiscSpace& space, double most) {
    if (part.angle == 0) return space.distance(part.from, part.to, most);
    const int chords = static_cast<int>(std::ceil(std::abs(part.angle) / chordAngle));
    Point last = part.from;
    for (int i = 1; i <= chords; ++i) {
        const Point next = i < chords ? onArc(part, static_cast<double>(i) / chords) : part.to;
        most = space.distance(last, next, most);
        last = next;
    }
    return most;
}

/// The directions in which a part begins and ends.
Point beginning(const PathPart& part) {
    if (part.angle == 0) return part.to - part.from;
    const Point out = part.from - part.centre;
    return part.angle > 0 ? Point{-out.y, out.x} : Point{out.y, -out.x};
}
Point ending(const PathPart& part) {
    if (part.angle == 0) return part.to - part.from;
    const Point out = part.to - part.centre;
    return part.angle > 0 ? Point{-out.y, out.x} : Point{out.y, -out.x};
}

double angleFrom(const Point& a, const Point& b) { return std::abs(arcTangent(cross(a, b), dot(a, b))); }

}  // namespace

double PathPart::length() const { return angle == 0 ? distance(from, to) : std::abs(angle) * distance(centre, from); }

Path pathOf(std::vector<PathPart> parts) {
    std::erase_if(parts, [](const PathPart& part) { return part.length() < noLength; });
    return {Path::Outcome::found, std::move(parts)};
}

Path pathThrough(const std::vector<Point>& points) {
    std::vector<PathPart> parts;
    for (std::size_t i = 1; i < points.size(); ++i) parts.push_back({points[i - 1], points[i]});
    return pathOf(std::move(parts));
}

double lengthOf(const Path& path) {
    double sum = 0;
    for (const PathPart& part : path.parts) sum += part.length();
    return sum;
}

double turnsOf(const Path& path) {
    double sum = 0;
    for (std::size_t i = 0; i < path.parts.size(); ++i) {
        sum += std::abs(path.parts[i].angle);
        if (i > 0) sum += angleFrom(ending(path.parts[i - 1]), beginning(path.parts[i]));
    }
    return sum;
}

double leastDistanceOf(const Path& path, const DiscSpace& space) {
    double least = farthestDistance;
    for (const PathPart& part : path.parts) least = distanceOf(part, space, least);
    return least;
}

std::vector<Point> pointsOf(const Path& path, double most) {
    std::vector<Point> points;
    for (const PathPart& part : path.parts) {
        if (points.empty()) points.push_back(part.from);
        if (part.angle != 0) {
            // The corners of the polygon whose sides touch the arc.
            const int sides = static_cast<int>(std::ceil(std::abs(part.angle) / most));
            const double out = 1 / cosine(part.angle / (2 * sides));
            for (int i = 0; i < sides; ++i)
                points.push_back(part.centre + out * (onArc(part, (i + 0.5) / sides) - part.centre));
        }
        points.push_back(part.to);
    }
    return points;
}

double lengthOf(std::span<const Point> points) {
    double sum = 0;
    for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
    return sum;
}

PathEnds freedEnds(const DiscSpace& space, const Point& start, const Point& goal) {
    const std::optional<Point> freeStart = space.freed(start), freeGoal = space.freed(goal);
    PathEnds ends;
    if (!freeStart) {
        ends.outcome = Path::Outcome::startBlocked;
    } else if (!freeGoal) {
        ends.outcome = Path::Outcome::goalBlocked;
    } else {
        ends.start = *freeStart;
        ends.goal = *freeGoal;
    }
    return ends;
}

}  // namespace mrose
