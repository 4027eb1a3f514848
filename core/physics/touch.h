#pragma once

#include <array>
#include <cstdint>

#include "geometry/gap.h"

namespace mrose {

/// Bodies touch at this distance, so that none ever really overlaps another: m.
constexpr double touchDistance = 5e-5;
/// And are taken for touching up to this much farther, m.
constexpr double touchSlack = 5e-6;

/// Where two pieces touch, or nearly do: the points between them at which they may press.
struct Touch {
    struct Spot {
        Point position;           ///< in the world, half way between the two
        double distance = 0;      ///< m along the normal; negative where they overlap
        std::uint32_t which = 0;  ///< tells it from the pair's other one, from tick to tick
    };
    Point normal;  ///< from the first to the second, length 1
    std::array<Spot, 2> spots{};
    int count = 0;
};

/// Of two pieces in the world; `gap` is theirs.
Touch findTouch(const ConvexPiece& a, const ConvexPiece& b, const Gap& gap);

}  // namespace mrose
