#include "planning/planner.h"

#include "planning/potential_field.h"
#include "planning/via_points.h"
#include "planning/visibility_graph.h"
#include "planning/voronoi_roadmap.h"

namespace mrose {

Path plannedPath(Planner planner, const DiscSpace& space, const Point& start, const Point& goal) {
    switch (planner) {
        case Planner::potentialField:
            return potentialFieldPath(space, start, goal).path;
        case Planner::visibilityGraph:
            return shortestPath(space, start, goal);
        case Planner::voronoi:
            return greatestClearancePath(space, start, goal);
        case Planner::viaPoints:
            return viaPointPath(space, start, goal);
    }
    return {};
}

}  // namespace mrose
