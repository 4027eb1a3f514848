#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "geometry/point.h"

namespace mrose {

/// Corners in order, the last joined to the first.
using Polygon = std::vector<Point>;

/// Positive where the corners go counter-clockwise, m2.
double signedArea(std::span<const Point> polygon);

/// Area, its centre, and its polar moment about that centre (m4), of a polygon in either sense.
struct AreaMoments {
    double area = 0;
    Point centroid;
    double polar = 0;
};
AreaMoments areaMoments(std::span<const Point> polygon);

/// Two edges (by their first corners) that cross, touch or lie on one another without being neighbours, or neighbours
/// that fold back; nullopt where the polygon is simple.
std::optional<std::pair<std::size_t, std::size_t>> selfIntersection(std::span<const Point> polygon);

/// Inside or on the edge.
bool contains(std::span<const Point> polygon, const Point& point);

double distanceToSegment(const Point& point, const Point& a, const Point& b);

/// The polygon as convex pieces without overlap, counter-clockwise, of at most `maxCorners` corners each: ears are cut
/// off and joined again where the union stays convex (Hertel and Mehlhorn 1983). Corners on a straight line are left
/// out. The polygon must be simple.
std::vector<Polygon> convexPieces(std::span<const Point> polygon, std::size_t maxCorners = 8);

}  // namespace mrose
