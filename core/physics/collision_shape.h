#pragma once

#include <memory>
#include <span>

#include "geometry/shape.h"

namespace mrose {

/// Convex pieces made ready for the contact solver; shared by all bodies of one shape.
class CollisionShape {
public:
    explicit CollisionShape(std::span<const ConvexPiece> pieces);

    struct Prepared;
    const Prepared& prepared() const { return *prepared_; }

private:
    std::shared_ptr<const Prepared> prepared_;
};

}  // namespace mrose
