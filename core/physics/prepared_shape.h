#pragma once

#include <variant>
#include <vector>

#include <box2d/box2d.h>

#include "physics/collision_shape.h"

namespace mrose {

/// Box2D keeps a skin of about a hundredth of its unit round polygons: with ten units to the metre that is a
/// millimetre.
constexpr double unitsPerMetre = 10;

struct CollisionShape::Prepared {
    std::vector<ConvexPiece> pieces;
    std::vector<std::variant<b2PolygonShape, b2CircleShape>> shapes;

    const b2Shape& shape(std::size_t piece) const {
        return std::visit([](const auto& s) -> const b2Shape& { return s; }, shapes[piece]);
    }
};

}  // namespace mrose
