#pragma once

#include <span>
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

    bool found() const { return outcome == Outcome::found; }
};

/// The path of these parts; parts without length are left out.
Path pathOf(std::vector<PathPart> parts);
Path pathThrough(const std::vector<Point>& points);

double lengthOf(const Path& path);  ///< m
double turnsOf(const Path& path);   ///< rad, all changes of its direction added up
/// m, of the centre from a piece, at most `farthestDistance`; of arcs within 0.1 mm.
double leastDistanceOf(const Path& path, const DiscSpace& space);
constexpr double farthestDistance = 10;  ///< m

/// Points of a path from its start to its goal, a straight way between any two: of arcs one at least every `most` rad,
/// a little outside, so that the way touches the arc and does not cut it.
std::vector<Point> pointsOf(const Path& path, double most = 0.35);

double lengthOf(std::span<const Point> points);  ///< m, of the way through them

/// Start and goal as planners take them: a disc that is too near to a piece first goes out of it by the shortest way,
/// and comes to such a goal last.
struct PathEnds {
    Path::Outcome outcome = Path::Outcome::found;
    Point start, goal;  ///< free
};
PathEnds freedEnds(const DiscSpace& space, const Point& start, const Point& goal);

}  // namespace mrose
