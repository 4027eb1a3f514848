#include "sensing/outlines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sensing/sensor_view.h"

namespace mrose {
namespace {

constexpr double outlineRounding = 1e-9;

/// The placement of `inner` in what `outer` is placed in.
Placement composed(const Placement& outer, const Placement& inner) {
    Placement all;
    all.origin = outer.place(inner.origin);
    all.cosine = outer.cosine * inner.cosine - outer.sine * inner.sine;
    all.sine = outer.sine * inner.cosine + outer.cosine * inner.sine;
    return all;
}

/// The placement of `of` as seen from `from`.
Placement seenFrom(const Placement& from, const Placement& of) {
    Placement seen;
    seen.origin = from.placeBack(of.origin);
    seen.cosine = from.cosine * of.cosine + from.sine * of.sine;
    seen.sine = from.cosine * of.sine - from.sine * of.cosine;
    return seen;
}

}  // namespace

void Outlines::find(const SensorView& view, const Pose& frame_B, const Sector& sector) {
    corners_.clear();
    polygons_.clear();
    circles_.clear();
    sector_ = sector;
    frame_ = composed(Placement(view.poseAt(view.robot, view.measured)), Placement(frame_B));
    const auto [s, c] = sector.halfAngle < std::numbers::pi ? sineCosine(sector.halfAngle) : SineCosine{0, -1};
    halfSine_ = s;
    halfCosine_ = c;
    Point least, most;
    const auto hold = [&](const Point& direction) {
        least = {std::min(least.x, direction.x), std::min(least.y, direction.y)};
        most = {std::max(most.x, direction.x), std::max(most.y, direction.y)};
    };
    hold(frame_.rotate({halfCosine_, halfSine_}));
    hold(frame_.rotate({halfCosine_, -halfSine_}));
    for (const Point& axis : {Point{1, 0}, Point{-1, 0}, Point{0, 1}, Point{0, -1}})
        if (frame_.rotateBack(axis).x >= halfCosine_ - outlineRounding) hold(axis);
    const double reach = sector.range * (1 + outlineRounding);
    least_ = frame_.origin + reach * least;
    most_ = frame_.origin + reach * most;
    addObstacles(view);
    addBodies(view);
}

/// Whether a disc, in the frame, is not wholly outside: beyond the range, or beyond the nearer of the sector's edges.
bool Outlines::inSector(const Point& centre, double reach) const {
    const double far = sector_.range + reach;
    if (dot(centre, centre) > far * far * (1 + outlineRounding)) return false;
    return std::abs(centre.y) * halfCosine_ - centre.x * halfSine_ <= reach + outlineRounding;
}

void Outlines::add(const ConvexPiece& piece, const Placement& placement, const Owner& owner) {
    if (!inSector(placement.place(piece.centre), piece.reach)) return;
    if (piece.isCircle()) {
        circles_.push_back({placement.place(piece.corners[0]), piece.radius, owner});
        return;
    }
    const auto first = static_cast<std::uint32_t>(corners_.size());
    for (std::size_t i = 0; i < piece.count; ++i) corners_.push_back(placement.place(piece.corners[i]));
    polygons_.push_back({first, static_cast<std::uint32_t>(corners_.size()), owner});
}

void Outlines::addObstacles(const SensorView& view) {
    const ObstacleIndex& obstacles = view.obstacles;
    const Placement seen = seenFrom(frame_, Placement());
    obstacles.visitBox(least_, most_, [&](std::uint32_t piece) {
        add(obstacles.pieces()[piece], seen, {obstacles.obstacleOf(piece), obstacles.partOf(piece), true});
    });
}

void Outlines::addBodies(const SensorView& view) {
    const double widest = view.scene.widestReach();
    const Point pad{widest, widest};
    const SensorView::Moment moment = view.momentOf(view.measured);
    view.bodiesAt(moment).grid.visitBox(least_ - pad, most_ + pad, [&](std::span<const PointGrid::Entry> entries) {
        for (const PointGrid::Entry& entry : entries) {
            const std::uint32_t body = entry.number;
            if (!inSector(frame_.placeBack(entry.point), widest) || body == view.robot) continue;
            const Shape& shape = view.scene.shapeOf(body);
            const Placement seen = seenFrom(frame_, Placement(view.poseAt(body, moment)));
            for (std::size_t i = 0; i < shape.pieces.size(); ++i)
                add(shape.pieces[i], seen, {body, shape.partOfPiece[i], false});
        }
    });
}

}  // namespace mrose
