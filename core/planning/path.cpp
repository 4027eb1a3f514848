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

Path pathOf(std::vector<PathPart> parts, const DiscSpace& space) {
    std::erase_if(parts, [](const PathPart& part) { return part.length() < noLength; });
    Path path;
    path.outcome = Path::Outcome::found;
    path.parts = std::move(parts);
    path.leastDistance = farthestDistance;
    for (std::size_t i = 0; i < path.parts.size(); ++i) {
        const PathPart& part = path.parts[i];
        path.length += part.length();
        path.turns += std::abs(part.angle);
        if (i > 0) path.turns += angleFrom(ending(path.parts[i - 1]), beginning(part));
        path.leastDistance = distanceOf(part, space, path.leastDistance);
    }
    return path;
}

Path pathThrough(const std::vector<Point>& points, const DiscSpace& space) {
    std::vector<PathPart> parts;
    for (std::size_t i = 1; i < points.size(); ++i) parts.push_back({points[i - 1], points[i]});
    return pathOf(std::move(parts), space);
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
