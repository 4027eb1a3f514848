#pragma once

#include <vector>

#include "planning/disc_space.h"

namespace mrose {

/// A piece of a path: a straight line, or an arc about a centre.
struct PathPart {
    Point from, to;
    Point centre = {};  ///< of an arc
    double angle = 0;   ///< rad, of an arc, to the left; 0: a line

    double length() const;
};

/// A way of a disc's centre.
struct Path {
    enum class Outcome { found, startBlocked, goalBlocked, noWay };

    Outcome outcome = Outcome::noWay;
    std::vector<PathPart> parts;  ///< each begins where the one before ends; none where no way was found
    double length = 0;            ///< m
    double leastDistance = 0;     ///< m, of the centre from a piece, at most `farthestDistance`; of arcs within 0.1 mm
    double turns = 0;             ///< rad, all changes of its direction added up

    bool found() const { return outcome == Outcome::found; }
};
constexpr double farthestDistance = 10;  ///< m

/// The path of these parts, measured in its space; parts without length are left out.
Path pathOf(std::vector<PathPart> parts, const DiscSpace& space);
Path pathThrough(const std::vector<Point>& points, const DiscSpace& space);

/// Points of a path from its start to its goal, a straight way between any two: of arcs one at least every `most` rad,
/// a little outside, so that the way touches the arc and does not cut it.
std::vector<Point> pointsOf(const Path& path, double most = 0.35);

/// Start and goal as planners take them: a disc that is too near to a piece first goes out of it by the shortest way,
/// and comes to such a goal last.
struct PathEnds {
    Path::Outcome outcome = Path::Outcome::found;
    Point start, goal;  ///< free
};
PathEnds freedEnds(const DiscSpace& space, const Point& start, const Point& goal);

}  // namespace mrose
