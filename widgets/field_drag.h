#pragma once

#include <QPointF>
#include <optional>

#include "widgets/field_drawing.h"

namespace mrose {

/// Pixels beside a body, or beside a sign, that count as on it.
constexpr double grabPixels = 6;

/// The uppermost body there, within a few pixels.
std::optional<std::size_t> bodyAt(const FieldFrame& frame, const ViewTransform& view, const QPointF& pixels);
/// At the end of the selected robot's arrow.
bool isOnKnob(const FieldFrame& frame, const FieldFocus& focus, const ViewTransform& view, const QPointF& pixels);

/// What a pressed button of the mouse does to the field.
struct FieldDrag {
    enum class Kind { none, pressed, pan, move, turn, measure };
    Kind kind = Kind::none;
    Qt::MouseButton button = Qt::NoButton;
    QPointF from, to;                     ///< pixels
    bool onBody = false, onKnob = false;  ///< that is where it was pressed

    bool ofBody() const { return kind == Kind::move || kind == Kind::turn; }
    /// What becomes of a press when the mouse has gone on; `onSelected`: the selected body lies where it was pressed.
    Kind dragged(bool onSelected, bool editable) const;
    /// Where it brings a body; `round`: in round numbers.
    Pose posed(const Pose& pose, const ViewTransform& view, bool round) const;
};

}  // namespace mrose
