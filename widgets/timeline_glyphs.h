#pragma once

#include <QPainter>

#include "debug/timeline_mark.h"
#include "widgets/theme.h"

namespace mrose {

constexpr int markKinds = 7;

QColor markColour(TimelineMark::Kind kind, const Theme& theme);
/// A sign about 9 pixels wide, of another shape for each kind: not everyone distinguishes colours.
void drawMark(QPainter& painter, const QPointF& middle, TimelineMark::Kind kind, const Theme& theme);
/// "kick", "controller failed"
QString markName(TimelineMark::Kind kind);
/// The same as one letter of text, where nothing can be drawn.
QString markLetter(TimelineMark::Kind kind);

}  // namespace mrose
