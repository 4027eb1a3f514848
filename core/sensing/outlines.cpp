#include "sensing/outlines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sensing/sector_box.h"
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
    addObstacles(view);
    addBodies(view);
}

/// Whether a disc, in the frame, is not wholly outside: beyond the range, or beyond the nearer of the sector's edges.
bool Outlines::inSector(const Point& centre, double reach) const {
    const double far = sector_.range + reach;
    if (dot(centre, centre) > far * far * (1 + outlineRounding)) return false;
    return std::abs(centre.y) * halfCosine_ - centre.x * halfSine_ <= reach + outlineRounding;
}

void Outlines::add(const ConvexPiece& piece, const Placement& placement, std::uint32_t owner) {
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
    const auto [least, most] = boxOfSector(frame_, halfCosine_, halfSine_, sector_.range, 0);
    const auto bodies = static_cast<std::uint32_t>(view.scene.bodyCount());
    obstacles.visitBox(least, most, [&](std::uint32_t piece) {
        add(obstacles.pieces()[piece], seen, bodies + obstacles.obstacleOf(piece));
    });
}

void Outlines::addBodies(const SensorView& view) {
    const double widest = view.scene.widestReach();
    const auto [least, most] = boxOfSector(frame_, halfCosine_, halfSine_, sector_.range, widest);
    const SensorView::Moment moment = view.momentOf(view.measured);
    view.bodiesAt(moment).grid.visitBox(least, most, [&](std::span<const PointGrid::Entry> entries) {
        for (const PointGrid::Entry& entry : entries) {
            const std::uint32_t body = entry.number;
            if (!inSector(frame_.placeBack(entry.point), widest) || body == view.robot) continue;
            const Shape& shape = view.scene.shapeOf(body);
            const Placement seen = seenFrom(frame_, Placement(view.poseAt(body, moment)));
            for (const ConvexPiece& piece : shape.pieces) add(piece, seen, body);
        }
    });
}

}  // namespace mrose
