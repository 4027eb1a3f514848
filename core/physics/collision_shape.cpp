#include "physics/collision_shape.h"

#include <algorithm>

namespace mrose {

CollisionShape::CollisionShape(std::span<const ConvexPiece> outlines, const Point& centre) {
    for (const ConvexPiece& outline : outlines) {
        double turning = 0;
        for (std::size_t i = 0; i < outline.count; ++i)
            turning = std::max(turning, distance(centre, outline.corners[i]));
        pieces.push_back({outline, turning});
    }
}

}  // namespace mrose
