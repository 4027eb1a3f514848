#include "planning/planner.h"

#include <utility>

#include "planning/potential_field.h"
#include "planning/via_points.h"
#include "planning/visibility_graph.h"

namespace mrose {

PathFinder::PathFinder(Planner planner, DiscSpace space) : planner_(planner), space_(std::move(space)) {
    if (planner_ == Planner::voronoi) roadmap_.emplace(space_);
    if (planner_ == Planner::visibilityGraph) corners_.emplace(space_);
}

PathFinder::PathFinder(const PathFinder& finder, std::span<const ConvexPiece> more)
    : planner_(finder.planner_), space_(finder.space_.with(more)) {
    if (planner_ == Planner::voronoi) roadmap_.emplace(space_);
    if (planner_ == Planner::visibilityGraph) corners_.emplace(*finder.corners_, space_);
}

Path PathFinder::path(const Point& start, const Point& goal) const {
    switch (planner_) {
        case Planner::potentialField:
            return potentialFieldPath(space_, start, goal).path;
        case Planner::visibilityGraph:
            return shortestPath(space_, *corners_, start, goal);
        case Planner::voronoi:
            return roadmap_->path(start, goal);
        case Planner::viaPoints:
            return viaPointPath(space_, start, goal);
    }
    return {};
}

}  // namespace mrose
