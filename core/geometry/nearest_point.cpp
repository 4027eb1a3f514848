#include "geometry/nearest_point.h"

#include <algorithm>
#include <limits>

namespace mrose {
namespace {

Point nearestOnSegment(const Point& place, const Point& a, const Point& b) {
    const Point along = b - a;
    return a + std::clamp(dot(place - a, along) / dot(along, along), 0.0, 1.0) * along;
}

NearestPoint towardsPoint(const Point& place, const Point& nearest) {
    const double far = distance(nearest, place);
    return {nearest, far > 0 ? (1 / far) * (place - nearest) : Point{1, 0}, far};
}

/// Whether a straight way enters a polygon: what is left of it after each edge has cut off what lies outside.
bool enters(const ConvexPiece& polygon, const Point& a, const Point& b) {
    double from = 0, to = 1;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const double atA = dot(polygon.normals[i], a - polygon.corners[i]),
                     atB = dot(polygon.normals[i], b - polygon.corners[i]);
        if (atA > 0 && atB > 0) return false;
        if (atA > 0) from = std::max(from, atA / (atA - atB));
        if (atB > 0) to = std::min(to, atA / (atA - atB));
        if (from > to) return false;
    }
    return true;
}

}  // namespace

NearestPoint nearestPoint(const ConvexPiece& piece, const Point& place) {
    if (piece.isCircle()) {
        const NearestPoint centre = towardsPoint(place, piece.centre);
        return {piece.centre + piece.radius * centre.away, centre.away, centre.distance - piece.radius};
    }
    NearestPoint inside{{}, {}, -std::numeric_limits<double>::infinity()}, best;
    best.distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < piece.count; ++i) {
        const Point& corner = piece.corners[i];
        if (const double outside = dot(piece.normals[i], place - corner); outside > inside.distance)
            inside = {place - outside * piece.normals[i], piece.normals[i], outside};
        const Point nearest = nearestOnSegment(place, corner, piece.corners[(i + 1) % piece.count]);
        if (const double far = distance(nearest, place); far < best.distance) best = towardsPoint(place, nearest);
    }
    return inside.distance <= 0 ? inside : best;
}

double leastDistance(const ConvexPiece& piece, const Point& place) {
    if (piece.isCircle()) return distance(piece.centre, place) - piece.radius;
    double outside = dot(piece.normals[0], place - piece.corners[0]);
    for (std::size_t i = 1; i < piece.count; ++i)
        outside = std::max(outside, dot(piece.normals[i], place - piece.corners[i]));
    return outside;
}

double distanceToWay(const ConvexPiece& piece, const Point& a, const Point& b) {
    if (a == b) return std::max(0.0, nearestPoint(piece, a).distance);
    if (piece.isCircle()) return std::max(0.0, distanceToSegment(piece.centre, a, b) - piece.radius);
    if (enters(piece, a, b)) return 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < piece.count; ++i) {
        const Point &corner = piece.corners[i], &next = piece.corners[piece.cornerAfter(i)];
        least = std::min({least, distanceToSegment(corner, a, b), distanceToSegment(a, corner, next),
                          distanceToSegment(b, corner, next)});
    }
    return least;
}

}  // namespace mrose
