#pragma once

#include <QFont>
#include <QMarginsF>

#include "widgets/field_painter.h"

namespace mrose {

/// How a view draws the field, whatever happens there: paints any tick as the view would show it, also where there is
/// no window, and in any thread, but in one at a time. Names stay where they stood in the picture before.
struct FieldPicture {
    ViewTransform view;
    Theme theme;
    FieldLayers layers;
    FieldFocus focus;
    bool following = false;  ///< the selected body stays in the middle
    QFont font;
    std::optional<Area> whole = {};  ///< the view is fitted to it: so are pictures of any size
    QMarginsF margins = {};          ///< about it, pixels
    LabelPlacer labels = {};
    FieldLegend legend = {};

    /// In a picture of another size at least as much is seen as in the view.
    void paint(QPainter& painter, const QSizeF& size, const FieldFrame& frame);
};

}  // namespace mrose
