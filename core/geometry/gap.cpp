#include "geometry/gap.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace mrose {
namespace {

constexpr double rounding = 1e-9;  // m: nearer points say nothing of a direction

/// The edge of `a` that `b` lies farthest outside of, and b's corner nearest to it.
struct WidestEdge {
    double outside = -std::numeric_limits<double>::infinity();  ///< m
    std::size_t edge = 0, corner = 0;
};

WidestEdge widestEdge(const ConvexPiece& a, const ConvexPiece& b) {
    WidestEdge widest;
    for (std::size_t i = 0; i < a.count; ++i) {
        const Point& normal = a.normals[i];
        const double edge = dot(normal, a.corners[i]);
        double least = std::numeric_limits<double>::infinity();
        std::size_t corner = 0;
        const double enough = edge + widest.outside;  // a corner that is no farther outside settles it
        for (std::size_t j = 0; j < b.count; ++j)
            if (const double there = dot(normal, b.corners[j]); there < least) {
                least = there;
                corner = j;
                if (there <= enough) break;
            }
        if (least > enough) widest = {least - edge, i, corner};
    }
    return widest;
}

Point nearestOnEdge(const ConvexPiece& piece, std::size_t edge, const Point& point) {
    const Point& from = piece.corners[edge];
    const Point way = piece.corners[piece.cornerAfter(edge)] - from;
    return from + std::clamp(dot(point - from, way) / dot(way, way), 0.0, 1.0) * way;
}

/// Whether the point's foot on the line through an edge lies on the edge.
bool beside(const ConvexPiece& piece, std::size_t edge, const Point& point) {
    const Point& from = piece.corners[edge];
    const Point way = piece.corners[piece.cornerAfter(edge)] - from;
    const double along = dot(point - from, way);
    return along >= 0 && along <= dot(way, way);
}

struct NearestPoints {
    double square = std::numeric_limits<double>::infinity();
    Point onCorners, onEdges;
};

NearestPoints cornersToEdges(const ConvexPiece& corners, const ConvexPiece& edges) {
    NearestPoints nearest;
    for (std::size_t i = 0; i < corners.count; ++i)
        for (std::size_t j = 0; j < edges.count; ++j) {
            const Point foot = nearestOnEdge(edges, j, corners.corners[i]), way = foot - corners.corners[i];
            if (const double square = dot(way, way); square < nearest.square)
                nearest = {square, corners.corners[i], foot};
        }
    return nearest;
}

Gap ofCircles(const Point& a, double radiusOfA, const Point& b, double radiusOfB) {
    const Point way = b - a;
    const double far = length(way);
    const Point axis = far > 0 ? (1 / far) * way : Point{1, 0};
    return {far - radiusOfA - radiusOfB, axis, a + radiusOfA * axis};
}

/// Of two polygons where `edges` has the nearest edge, `first` says whether it is the first of the two.
Gap alongEdge(const ConvexPiece& edges, const ConvexPiece& corners, const WidestEdge& widest, bool first) {
    const Point &normal = edges.normals[widest.edge], &corner = corners.corners[widest.corner];
    const auto edge = static_cast<std::uint8_t>(widest.edge), nearest = static_cast<std::uint8_t>(widest.corner);
    if (first) return {widest.outside, normal, corner - widest.outside * normal, Gap::Edge::ofFirst, edge, nearest};
    return {widest.outside, -1 * normal, corner, Gap::Edge::ofSecond, edge, nearest};
}

/// The edge that the other's centre is farthest outside of, mostly the nearest one, if it is: an edge that all of the
/// other lies outside of, whose nearest corner lies beside it, is as near as anything.
std::optional<WidestEdge> facingEdge(const ConvexPiece& edges, const ConvexPiece& corners) {
    WidestEdge facing;
    for (std::size_t i = 0; i < edges.count; ++i)
        if (const double outside = dot(edges.normals[i], corners.centre - edges.corners[i]); outside > facing.outside)
            facing = {outside, i, 0};
    const Point& normal = edges.normals[facing.edge];
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < corners.count; ++j)
        if (const double there = dot(normal, corners.corners[j]); there < least) {
            least = there;
            facing.corner = j;
        }
    facing.outside = least - dot(normal, edges.corners[facing.edge]);
    if (facing.outside > rounding && beside(edges, facing.edge, corners.corners[facing.corner])) return facing;
    return std::nullopt;
}

Gap ofPolygonAndCircle(const ConvexPiece& a, const ConvexPiece& b) {
    const WidestEdge widest = widestEdge(a, b);
    const Point& centre = b.corners[0];
    if (widest.outside > rounding && !beside(a, widest.edge, centre)) {
        Point nearest = a.corners[0];
        double square = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < a.count; ++i)
            if (const Point foot = nearestOnEdge(a, i, centre), way = centre - foot; dot(way, way) < square) {
                square = dot(way, way);
                nearest = foot;
            }
        return ofCircles(nearest, 0, centre, b.radius);
    }
    const Point& axis = a.normals[widest.edge];
    return {widest.outside - b.radius, axis, centre - widest.outside * axis, Gap::Edge::ofFirst,
            static_cast<std::uint8_t>(widest.edge)};
}

Gap ofPolygons(const ConvexPiece& a, const ConvexPiece& b) {
    const bool longer = a.reach > b.reach;
    for (const bool first : {longer, !longer}) {
        const ConvexPiece &edges = first ? a : b, &corners = first ? b : a;
        if (const auto facing = facingEdge(edges, corners)) return alongEdge(edges, corners, *facing, first);
    }
    const WidestEdge ofA = widestEdge(a, b), ofB = widestEdge(b, a);
    const bool first = ofA.outside >= ofB.outside;
    const ConvexPiece &edges = first ? a : b, &corners = first ? b : a;
    const WidestEdge& widest = first ? ofA : ofB;
    if (widest.outside > rounding && !beside(edges, widest.edge, corners.corners[widest.corner])) {
        const NearestPoints toA = cornersToEdges(b, a), toB = cornersToEdges(a, b);
        const Point onA = toA.square <= toB.square ? toA.onEdges : toB.onCorners;
        const Point onB = toA.square <= toB.square ? toA.onCorners : toB.onEdges;
        const Gap gap = ofCircles(onA, 0, onB, 0);
        if (gap.distance > widest.outside + rounding) return gap;
    }
    return alongEdge(edges, corners, widest, first);
}

}  // namespace

Gap gapBetween(const ConvexPiece& a, const ConvexPiece& b) {
    if (a.isCircle() && b.isCircle()) return ofCircles(a.corners[0], a.radius, b.corners[0], b.radius);
    if (b.isCircle()) return ofPolygonAndCircle(a, b);
    if (!a.isCircle()) return ofPolygons(a, b);
    Gap gap = ofPolygonAndCircle(b, a);
    gap.at = gap.at + gap.distance * gap.axis;
    gap.axis = -1 * gap.axis;
    if (gap.edge == Gap::Edge::ofFirst) gap.edge = Gap::Edge::ofSecond;
    return gap;
}

}  // namespace mrose
