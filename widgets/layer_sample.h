#pragma once

#include <QPainter>

#include "widgets/field_layers.h"
#include "widgets/theme.h"

namespace mrose {

/// Whether a layer looks like something that a legend can show.
bool hasSample(FieldLayer layer);
/// A way and an outline, as one of the overlaid motion models has them.
void drawModelSample(QPainter& painter, const QRectF& box, std::size_t model);
/// What it draws, small, as menu and legend show it.
void drawSample(QPainter& painter, const QRectF& box, FieldLayer layer, const Theme& theme);

}  // namespace mrose
