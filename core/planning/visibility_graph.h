#pragma once

#include "planning/path.h"
#include "planning/round_corners.h"

namespace mrose {

/// The shortest way of a disc among its pieces: straight lines and arcs round grown corners and circles, which touch
/// each other as tangents (the tangent or reduced visibility graph; Liu and Arimoto 1992), found by A* whose tangents
/// are made as they are needed. Exact. Pieces may overlap.
Path shortestPath(const DiscSpace& space, const RoundCorners& corners, const Point& start, const Point& goal);
/// The same, of the space's own corners.
Path shortestPath(const DiscSpace& space, const Point& start, const Point& goal);

}  // namespace mrose
