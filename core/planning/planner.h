#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "planning/round_corners.h"
#include "planning/voronoi_roadmap.h"

namespace mrose {

enum class Planner { potentialField, visibilityGraph, voronoi, viaPoints };
constexpr std::array<std::string_view, 4> plannerNames{"potential_field", "visibility_graph", "voronoi", "via_points"};

/// Finds ways of a disc in one space by one of the planners. What that needs of the space it makes once.
class PathFinder {
public:
    PathFinder(Planner planner, DiscSpace space);
    /// The same planner in that space with `more` pieces behind its own.
    PathFinder(const PathFinder& finder, std::span<const ConvexPiece> more);

    Planner planner() const { return planner_; }
    const DiscSpace& space() const { return space_; }
    Path path(const Point& start, const Point& goal) const;

private:
    Planner planner_;
    DiscSpace space_;
    std::optional<VoronoiRoadmap> roadmap_;
    std::optional<RoundCorners> corners_;  ///< of the visibility graph
};

}  // namespace mrose
