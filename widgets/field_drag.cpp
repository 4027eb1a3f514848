#include "widgets/field_drag.h"

#include <QLineF>
#include <cmath>
#include <numbers>

namespace mrose {
namespace {

/// What moves and turns are rounded to.
constexpr double roundMetres = 0.1, roundTurn = std::numbers::pi / 12;

double rounded(double value, double step) { return step * std::round(value / step); }

}  // namespace

std::optional<std::size_t> bodyAt(const FieldFrame& frame, const ViewTransform& view, const QPointF& pixels) {
    const Point at = view.toMetres(pixels);
    const double slack = grabPixels / view.scale();
    const ConvexPiece finger = ConvexPiece::circle(at, slack);
    for (std::size_t i = frame.scene().bodyCount(); i-- > 0;) {
        const Shape& shape = frame.scene().shapeOf(i);
        const Pose& pose = frame.poseOf(i);
        if (distance(position(pose), at) > shape.reach + slack) continue;
        const Placement placement(pose);
        for (const ConvexPiece& piece : shape.pieces)
            if (distance(placed(piece, placement), finger) <= 0) return i;
    }
    return std::nullopt;
}

bool isOnKnob(const FieldFrame& frame, const FieldFocus& focus, const ViewTransform& view, const QPointF& pixels) {
    if (!hasKnob(frame, focus)) return false;
    return QLineF(knobAt(view, frame, *focus.selected), pixels).length() <= knobRadius + grabPixels / 2;
}

FieldDrag::Kind FieldDrag::dragged(bool onSelected, bool editable) const {
    if (onKnob) return Kind::turn;
    if (onSelected && editable && button != Qt::MiddleButton)
        return button == Qt::RightButton ? Kind::turn : Kind::move;
    return button == Qt::RightButton ? Kind::none : Kind::pan;
}

Pose FieldDrag::posed(const Pose& pose, const ViewTransform& view, bool round) const {
    if (kind == Kind::move) {
        const Point at = position(pose) + view.toMetres(to) - view.toMetres(from);
        return {round ? rounded(at.x, roundMetres) : at.x, round ? rounded(at.y, roundMetres) : at.y, pose.heading};
    }
    const Point after = view.toMetres(to) - position(pose), before = view.toMetres(from) - position(pose);
    // From near its middle a body is turned to face the cursor, otherwise along with where it was taken.
    const bool near = length(before) * view.scale() < 2 * grabPixels;
    const double turned = std::atan2(after.y, after.x) - (near ? pose.heading : std::atan2(before.y, before.x));
    const double heading = pose.heading + turned;
    return {pose.x, pose.y, wrapAngle(round ? rounded(heading, roundTurn) : heading)};
}

}  // namespace mrose
