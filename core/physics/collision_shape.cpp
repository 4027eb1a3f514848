#include "physics/collision_shape.h"

#include <array>

#include "physics/prepared_shape.h"

namespace mrose {
namespace {

b2Vec2 toUnits(const Point& p) {
    return {static_cast<float>(p.x * unitsPerMetre), static_cast<float>(p.y * unitsPerMetre)};
}

b2CircleShape circle(const ConvexPiece& piece) {
    b2CircleShape shape;
    shape.m_p = toUnits(piece.corners[0]);
    shape.m_radius = static_cast<float>(piece.radius * unitsPerMetre);
    return shape;
}

b2PolygonShape polygon(const ConvexPiece& piece) {
    std::array<b2Vec2, ConvexPiece::maxCorners> corners;
    for (std::size_t i = 0; i < piece.count; ++i) corners[i] = toUnits(piece.corners[i]);
    b2PolygonShape shape;
    shape.Set(corners.data(), static_cast<int32>(piece.count));
    return shape;
}

}  // namespace

CollisionShape::CollisionShape(std::span<const ConvexPiece> pieces) {
    auto prepared = std::make_shared<Prepared>();
    prepared->pieces.assign(pieces.begin(), pieces.end());
    for (const ConvexPiece& piece : pieces) {
        if (piece.isCircle())
            prepared->shapes.emplace_back(circle(piece));
        else
            prepared->shapes.emplace_back(polygon(piece));
    }
    prepared_ = std::move(prepared);
}

}  // namespace mrose
