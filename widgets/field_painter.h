#pragma once

#include <utility>

#include "widgets/field_drawing.h"
#include "widgets/field_legend.h"

namespace mrose {

/// All that is drawn of an environment and of the bodies, in metres.
Area areaOf(const FieldFrame& frame);

/// Draws the place and what happens in it on anything that Qt paints on: a window, a picture, a file.
class FieldPainter {
public:
    FieldPainter(QPainter& painter, const ViewTransform& view, const Theme& theme, const FieldLayers& layers);

    /// What does not change from tick to tick: floor, markings, goals, walls, grid.
    void place(const Environment& environment);
    /// Bodies and all layers. `labels` remembers where names stood, `legend` where it did itself.
    void frame(const FieldFrame& frame, const FieldFocus& focus, LabelPlacer& labels, FieldLegend& legend);
    /// A scale bar in the lower left corner, which says so where the field is turned, and the legend, if that layer is
    /// shown.
    void corners(const FieldFrame& frame, const FieldLegend& legend);
    /// A distance measured by hand.
    void measure(const Point& from, const Point& to);

private:
    struct ScaleBar {
        QPointF left, right;
        FieldLabel label;
        QRectF plate;  ///< of the label
        QRectF box() const { return QRectF(left, right).adjusted(-4, -6, 4, 6) | plate; }
    };
    ScaleBar scaleBar() const;
    void ruler();
    std::pair<QRectF, FieldLabel> moved(const FieldFrame& frame, std::size_t body, const Pose& pose) const;

    FieldCanvas canvas_;
    const FieldLayers& layers_;
};

}  // namespace mrose
