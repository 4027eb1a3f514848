#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/polygon.h"

namespace mrose {

struct Colour {
    std::uint8_t red = 0, green = 0, blue = 0;
    bool operator==(const Colour&) const = default;
};

/// A convex polygon, or a circle as one corner with a radius: what contact and sight work on.
struct ConvexPiece {
    static constexpr std::size_t maxCorners = 8;

    std::array<Point, maxCorners> corners{};  ///< counter-clockwise
    std::array<Point, maxCorners> normals{};  ///< outward, length 1, of the edge from corner i to the next
    std::size_t count = 0;
    double radius = 0;  ///< of a circle, about its only corner; 0 for polygons
    Point centre;       ///< of a circle that holds the piece
    double reach = 0;   ///< its radius

    /// Of a convex polygon, counter-clockwise, as the contact solver can tell its corners apart (contact_corners.h).
    /// nullopt: there is none left.
    static std::optional<ConvexPiece> polygon(const Polygon& corners);
    static ConvexPiece circle(const Point& centre, double radius);
    bool isCircle() const { return count == 1; }
    std::size_t cornerAfter(std::size_t i) const { return i + 1 < count ? i + 1 : 0; }

private:
    ConvexPiece() = default;  // none is without corners
};

/// The same piece elsewhere.
ConvexPiece placed(const ConvexPiece& piece, const Placement& placement);

/// The distance between two pieces in one frame; negative where they overlap: the least depth along an edge's normal.
double distance(const ConvexPiece& a, const ConvexPiece& b);

/// Whether they are nearer than `limit`; quickly no where they are far.
bool nearer(const ConvexPiece& a, const ConvexPiece& b, double limit);

/// Whether two pieces that move on straight ways, from (a0, b0) to (a1, b1), stay apart: a line keeps more than `slack`
/// between them all the time, or more than `touch` and they come no nearer along it.
bool stayApart(const ConvexPiece& a0, const ConvexPiece& b0, const ConvexPiece& a1, const ConvexPiece& b1, double slack,
               double touch);

/// A polygon or a circle of one colour.
struct ShapePart {
    std::string name;
    Polygon polygon;    ///< empty for a circle
    Point centre;       ///< of a circle
    double radius = 0;  ///< of a circle, m
    Colour colour;
    bool operator==(const ShapePart&) const = default;
};

/// The outline of a robot or an object, about its reference point at the origin, x forward.
struct Shape {
    std::string name;
    std::vector<ShapePart> parts;

    // What follows is computed from the parts.
    std::vector<ConvexPiece> pieces;
    std::vector<std::uint32_t> partOfPiece;
    double reach = 0;     ///< m, of the farthest point from the origin
    double core = 0;      ///< m, radius of the largest disc about the origin that lies in one piece
    Point centroid;       ///< of the area
    double gyration = 0;  ///< m, radius of gyration of the area about its centroid

    /// Parts that overlap count twice in centroid and gyration. Parts must be simple polygons or circles of some size;
    /// what of a polygon is too thin for contact is in no piece.
    static Shape fromParts(std::string name, std::vector<ShapePart> parts);
};

}  // namespace mrose
