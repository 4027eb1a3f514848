#pragma once

#include <span>

#include "geometry/point.h"
#include "world/command.h"

namespace mrose {

// How far a disc about the origin, facing along x, gets among points until it touches one, up to `most` metres. A point
// that it touches already ends its way where it would come nearer, and not where it leaves it.

/// Along a straight line in `direction` (length 1).
double straightWay(std::span<const Point> points, const Point& direction, double radius, double most);

/// Along the arc of a constant velocity, forwards or backwards. A disc that turns on the spot meets nothing.
double arcWay(std::span<const Point> points, const Velocity& velocity, double radius, double most);

}  // namespace mrose
