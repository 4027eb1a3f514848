#include "physics/touch.h"

#include <box2d/b2_collision.h>

namespace mrose {
namespace {

// Spots farther than this from each other are left out: bodies at 5 m/s close so much in a tick, m.
constexpr double farthest = 0.1;

/// Where two edges lie side by side: the ends of that stretch of the one which has the corners.
struct Face {
    const ConvexPiece& owner;
    std::size_t edge;
    Point origin = owner.corners[edge], end = owner.corners[owner.cornerAfter(edge)], normal = owner.normals[edge];

    /// Along the edge, and outside of it.
    Point seen(const Point& p) const {
        const Point way = p - origin;
        return {cross(normal, way), dot(normal, way)};
    }
};

/// The edge at a corner that lies the more against a direction.
std::size_t opposingEdge(const ConvexPiece& piece, std::size_t corner, const Point& direction) {
    const std::size_t before = corner > 0 ? corner - 1 : piece.count - 1;
    return dot(piece.normals[before], direction) < dot(piece.normals[corner], direction) ? before : corner;
}

/// Box2D says which parts of the two edges lie opposite, and names them; where exactly they do is said in doubles.
void addOppositeSpots(const Face& face, const ConvexPiece& other, std::size_t edge, Touch& touch) {
    const std::array<std::size_t, 2> corners{edge, other.cornerAfter(edge)};
    std::array<Point, 2> seen;
    std::array<b2ClipVertex, 2> whole, cut, spots;
    for (int i = 0; i < 2; ++i) {
        seen[i] = face.seen(other.corners[corners[i]]);
        whole[i].v.Set(static_cast<float>(seen[i].x), static_cast<float>(seen[i].y));
        whole[i].id.cf = {static_cast<uint8>(face.edge), static_cast<uint8>(corners[i]), b2ContactFeature::e_face,
                          b2ContactFeature::e_vertex};
    }
    const double length = face.seen(face.end).x;
    const auto ends = static_cast<int32>(face.owner.cornerAfter(face.edge));
    const auto beside = [&](const Point& p) { return p.x >= 0 && p.x <= length; };
    if (beside(seen[0]) && beside(seen[1])) {
        spots = whole;
    } else {
        if (b2ClipSegmentToLine(cut.data(), whole.data(), {-1, 0}, 0, static_cast<int32>(face.edge)) < 2) return;
        if (b2ClipSegmentToLine(spots.data(), cut.data(), {1, 0}, static_cast<float>(length), ends) < 2) return;
    }
    for (const b2ClipVertex& spot : spots) {
        Point there;
        if (spot.id.cf.typeB == b2ContactFeature::e_vertex) {
            there = seen[spot.id.cf.indexB == corners[0] ? 0 : 1];
        } else {
            there.x = spot.id.cf.indexA == face.edge ? 0 : length;
            there.y = seen[0].y + (there.x - seen[0].x) / (seen[1].x - seen[0].x) * (seen[1].y - seen[0].y);
        }
        if (there.y > farthest) continue;
        const Point along{-face.normal.y, face.normal.x};
        touch.spots[touch.count++] = {face.origin + there.x * along + (there.y / 2) * face.normal, there.y,
                                      spot.id.key};
    }
}

}  // namespace

Touch findTouch(const ConvexPiece& a, const ConvexPiece& b, const Gap& gap) {
    Touch touch;
    touch.normal = gap.axis;
    if (gap.edge != Gap::Edge::none && !a.isCircle() && !b.isCircle()) {
        const bool first = gap.edge == Gap::Edge::ofFirst;
        const ConvexPiece &owner = first ? a : b, &other = first ? b : a;
        addOppositeSpots({owner, gap.edgeNumber}, other, opposingEdge(other, gap.corner, owner.normals[gap.edgeNumber]),
                         touch);
    }
    if (touch.count == 0) {
        touch.spots[0] = {gap.at + (gap.distance / 2) * gap.axis, gap.distance, 0};
        touch.count = 1;
    }
    return touch;
}

}  // namespace mrose
