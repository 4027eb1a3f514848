#pragma once

#include <span>
#include <vector>

#include "behaviour/steering.h"
#include "planning/path.h"

namespace mrose {

/// How far along a way through points a robot is, m: by the point of the way that is nearest to it, of those that lie
/// up to `most` metres beyond where it was.
double progressAlong(std::span<const Point> points, const Point& place, double was, double most = 1.0);
Point pointAt(std::span<const Point> points, double along);
/// The points that are still to come after so many metres.
std::vector<Point> pointsAfter(std::span<const Point> points, double along);

/// Along a way: towards a point of it some way ahead (pure pursuit; Coulter 1992), and to its last one slower and
/// slower. `progress` is where it is; it does not drive beyond `end`, m along the way.
Command followPath(std::span<const Point> points, const Pose& ahead, double progress, double end,
                   const DriveLimits& limits);

}  // namespace mrose
