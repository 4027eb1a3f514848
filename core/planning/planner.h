#pragma once

#include <array>
#include <string_view>

#include "planning/path.h"

namespace mrose {

enum class Planner { potentialField, visibilityGraph, voronoi, viaPoints };
constexpr std::array<std::string_view, 4> plannerNames{"potential_field", "visibility_graph", "voronoi", "via_points"};

/// A way of a disc by one of the planners.
Path plannedPath(Planner planner, const DiscSpace& space, const Point& start, const Point& goal);

}  // namespace mrose
