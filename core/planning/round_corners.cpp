#include "planning/round_corners.h"

#include <utility>

namespace mrose {
namespace {

/// Notes the pieces from `from` on that are near a corner; false: it lies within one of them.
bool noteNear(const DiscSpace& space, std::size_t from, RoundCorner& corner) {
    const auto pieces = space.pieces();
    const double reach = corner.radius + space.radius();
    for (std::size_t i = from; i < pieces.size(); ++i) {
        const Point line = pieces[i].centre - corner.centre;
        const double within = pieces[i].reach + reach;
        if (i == corner.piece || dot(line, line) >= within * within) continue;
        const double far = nearestPoint(pieces[i], corner.centre).distance;
        if (far < -DiscSpace::slack && !corner.full) return false;
        if (far < reach) corner.near.push_back(i);
    }
    return true;
}

}  // namespace

void RoundCorners::add(const DiscSpace& space, std::size_t from) {
    std::erase_if(corners_, [&](RoundCorner& corner) { return !noteNear(space, from, corner); });
    const auto pieces = space.pieces();
    for (std::size_t i = from; i < pieces.size(); ++i) {
        const ConvexPiece& piece = pieces[i];
        for (std::size_t k = 0; k < piece.count; ++k) {
            RoundCorner corner{.centre = piece.corners[k],
                               .radius = piece.radius + space.radius(),
                               .first = piece.normals[(k + piece.count - 1) % piece.count],
                               .last = piece.normals[k],
                               .full = piece.isCircle(),
                               .piece = i};
            if (noteNear(space, 0, corner)) corners_.push_back(std::move(corner));
        }
    }
    pieces_ = pieces.size();
}

}  // namespace mrose
