#include "planning/round_corners.h"

#include <utility>

namespace mrose {

/// Notes the pieces from `from` on that are near a corner, behind all others; false: it lies within one of them.
bool RoundCorners::noteNear(const DiscSpace& space, std::size_t from, RoundCorner& corner) {
    const auto pieces = space.pieces();
    const double reach = corner.radius + space.radius();
    for (std::size_t i = from; i < pieces.size(); ++i) {
        const Point line = pieces[i].centre - corner.centre;
        const double within = pieces[i].reach + reach;
        if (i == corner.piece || dot(line, line) >= within * within || leastDistance(pieces[i], corner.centre) >= reach)
            continue;
        const double far = nearestPoint(pieces[i], corner.centre).distance;
        if (far < -DiscSpace::slack && !corner.full) return false;
        if (far < reach) near_.push_back(i);
    }
    corner.countNear = near_.size() - corner.firstNear;
    return true;
}

void RoundCorners::add(const DiscSpace& space, std::size_t from) {
    const std::vector<RoundCorner> before = std::exchange(corners_, {});
    const std::vector<std::size_t> nearBefore = std::exchange(near_, {});
    const auto pieces = space.pieces();
    std::size_t corners = before.size();
    for (std::size_t i = from; i < pieces.size(); ++i) corners += pieces[i].count;
    corners_.reserve(corners);
    near_.reserve(nearBefore.size() + corners);
    const auto keep = [&](RoundCorner corner, std::span<const std::size_t> known, std::size_t first) {
        corner.firstNear = near_.size();
        near_.insert(near_.end(), known.begin(), known.end());
        if (noteNear(space, first, corner))
            corners_.push_back(corner);
        else
            near_.resize(corner.firstNear);
    };
    for (const RoundCorner& corner : before)
        keep(corner, std::span(nearBefore).subspan(corner.firstNear, corner.countNear), from);
    for (std::size_t i = from; i < pieces.size(); ++i) {
        const ConvexPiece& piece = pieces[i];
        for (std::size_t k = 0; k < piece.count; ++k)
            keep({.centre = piece.corners[k],
                  .radius = piece.radius + space.radius(),
                  .first = piece.normals[(k + piece.count - 1) % piece.count],
                  .last = piece.normals[k],
                  .full = piece.isCircle(),
                  .piece = i},
                 {}, 0);
    }
    pieces_ = pieces.size();
}

}  // namespace mrose
