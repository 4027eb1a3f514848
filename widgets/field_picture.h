#pragma once

#include <QFont>

#include "widgets/field_painter.h"

namespace mrose {

/// Between the place and the edges of a view that shows all of it, pixels.
inline constexpr double fitMargin = 16;

/// How a view draws the field, whatever happens there: paints any tick as the view would show it, also where there is
/// no window, and in any thread, but in one at a time. Names stay where they stood in the picture before.
struct FieldPicture {
    ViewTransform view;
    Theme theme;
    FieldLayers layers;
    FieldFocus focus;
    bool following = false;  ///< the selected body stays in the middle
    QFont font;
    std::optional<FieldArea> whole = {};  ///< the view shows all of the place: so do pictures of any size
    LabelPlacer labels = {};

    /// In a picture of another size at least as much is seen as in the view.
    void paint(QPainter& painter, const QSizeF& size, const FieldFrame& frame);
};

}  // namespace mrose
