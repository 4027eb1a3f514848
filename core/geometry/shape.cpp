#include "geometry/shape.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "geometry/contact_corners.h"
#include "geometry/gap.h"

namespace mrose {
namespace {

/// The gap between the pieces' shadows on a line along `axis`, from a to b.
double gapAlong(const Point& axis, const ConvexPiece& a, const ConvexPiece& b) {
    double most = -std::numeric_limits<double>::infinity(), least = -most;
    for (std::size_t i = 0; i < a.count; ++i) most = std::max(most, dot(axis, a.corners[i]));
    for (std::size_t i = 0; i < b.count; ++i) least = std::min(least, dot(axis, b.corners[i]));
    return least - b.radius - (most + a.radius);
}

/// From a's corner nearest to the circle `b`, or a's centre, to b's; zero where they coincide.
Point axisToCircle(const ConvexPiece& a, const ConvexPiece& b) {
    Point best = b.centre - a.corners[0];
    for (std::size_t i = 1; i < a.count; ++i)
        if (const Point to = b.centre - a.corners[i]; dot(to, to) < dot(best, best)) best = to;
    const double far = length(best);
    return far > 0 ? (1 / far) * best : Point{};
}

AreaMoments momentsOf(const ShapePart& part) {
    if (!part.polygon.empty()) return areaMoments(part.polygon);
    const double area = std::numbers::pi * part.radius * part.radius;
    return {area, part.centre, area * part.radius * part.radius / 2};
}

void addPieces(Shape& shape, const ShapePart& part, std::uint32_t index) {
    if (part.polygon.empty()) {
        shape.pieces.push_back(ConvexPiece::circle(part.centre, part.radius));
    } else {
        for (const Polygon& corners : convexPieces(part.polygon, ConvexPiece::maxCorners))
            if (const auto piece = ConvexPiece::polygon(corners)) shape.pieces.push_back(*piece);
    }
    shape.partOfPiece.resize(shape.pieces.size(), index);
}

}  // namespace

std::optional<ConvexPiece> ConvexPiece::polygon(const Polygon& polygon) {
    const Polygon corners = contactCorners(polygon);
    if (corners.empty() || corners.size() > maxCorners) return std::nullopt;
    ConvexPiece piece;
    piece.count = corners.size();
    std::copy_n(corners.begin(), piece.count, piece.corners.begin());
    Point least = corners.front(), most = corners.front();
    for (const Point& p : corners) {
        least = {std::min(least.x, p.x), std::min(least.y, p.y)};
        most = {std::max(most.x, p.x), std::max(most.y, p.y)};
    }
    piece.centre = 0.5 * (least + most);
    for (const Point& p : corners) piece.reach = std::max(piece.reach, mrose::distance(piece.centre, p));
    for (std::size_t i = 0; i < piece.count; ++i) {
        const Point edge = piece.corners[(i + 1) % piece.count] - piece.corners[i];
        piece.normals[i] = (1 / length(edge)) * Point{edge.y, -edge.x};
    }
    return piece;
}

ConvexPiece ConvexPiece::circle(const Point& centre, double radius) {
    ConvexPiece piece;
    piece.count = 1;
    piece.corners[0] = piece.centre = centre;
    piece.radius = piece.reach = radius;
    return piece;
}

ConvexPiece placed(const ConvexPiece& piece, const Placement& placement) {
    ConvexPiece result = piece;
    for (std::size_t i = 0; i < piece.count; ++i) {
        result.corners[i] = placement.place(piece.corners[i]);
        result.normals[i] = placement.rotate(piece.normals[i]);
    }
    result.centre = placement.place(piece.centre);
    return result;
}

double distance(const ConvexPiece& a, const ConvexPiece& b) { return gapBetween(a, b).distance; }

bool nearer(const ConvexPiece& a, const ConvexPiece& b, double limit) {
    const double reach = a.reach + b.reach + limit;
    const Point between = b.centre - a.centre;
    if (dot(between, between) > reach * reach) return false;
    return gapBetween(a, b).distance <= limit;
}

bool stayApart(const ConvexPiece& a0, const ConvexPiece& b0, const ConvexPiece& a1, const ConvexPiece& b1, double slack,
               double touch) {
    const auto divides = [&](const Point& axis) {
        const double before = gapAlong(axis, a0, b0);
        if (before <= touch) return false;
        const double after = gapAlong(axis, a1, b1);
        return after >= before || (before > slack && after > slack);
    };
    for (std::size_t i = 0; i < a0.count && !a0.isCircle(); ++i)
        if (divides(a0.normals[i])) return true;
    for (std::size_t i = 0; i < b0.count && !b0.isCircle(); ++i)
        if (divides(-1 * b0.normals[i])) return true;
    if (b0.isCircle()) return divides(axisToCircle(a0, b0));
    return a0.isCircle() && divides(-1 * axisToCircle(b0, a0));
}

namespace {

/// How deep within the piece the origin is.
double depthOfOrigin(const ConvexPiece& piece) {
    if (piece.isCircle()) return piece.radius - length(piece.corners[0]);
    double depth = dot(piece.normals[0], piece.corners[0]);
    for (std::size_t i = 1; i < piece.count; ++i) depth = std::min(depth, dot(piece.normals[i], piece.corners[i]));
    return depth;
}

}  // namespace

Shape Shape::fromParts(std::string name, std::vector<ShapePart> parts) {
    Shape shape;
    shape.name = std::move(name);
    shape.parts = std::move(parts);
    double area = 0, polar = 0;
    Point first;
    for (std::uint32_t i = 0; i < shape.parts.size(); ++i) {
        addPieces(shape, shape.parts[i], i);
        const AreaMoments moments = momentsOf(shape.parts[i]);
        area += moments.area;
        first = first + moments.area * moments.centroid;
        polar += moments.polar + moments.area * dot(moments.centroid, moments.centroid);
    }
    for (const ConvexPiece& piece : shape.pieces) {
        for (std::size_t i = 0; i < piece.count; ++i)
            shape.reach = std::max(shape.reach, length(piece.corners[i]) + piece.radius);
        shape.core = std::max(shape.core, depthOfOrigin(piece));
    }
    if (area > 0) {
        shape.centroid = (1 / area) * first;
        shape.gyration = std::sqrt(std::max(0.0, polar / area - dot(shape.centroid, shape.centroid)));
    }
    return shape;
}

}  // namespace mrose
