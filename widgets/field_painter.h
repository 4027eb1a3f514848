#pragma once

#include <optional>

#include <QPainter>

#include "widgets/field_frame.h"
#include "widgets/field_layers.h"
#include "widgets/theme.h"
#include "widgets/view_transform.h"

namespace mrose {

/// What the eye of the user is on.
struct FieldFocus {
    std::optional<std::size_t> selected, hovered;  ///< bodies
    std::optional<Pose> moved;                     ///< where the selected body is being dragged to
};

/// All that is drawn of an environment, in metres.
FieldArea areaOf(const Environment& environment);
/// Of the bodies as well.
FieldArea areaOf(const FieldFrame& frame);

/// Draws the place and what happens in it on anything that Qt paints on: a window, a picture, a file.
class FieldPainter {
public:
    FieldPainter(QPainter& painter, const ViewTransform& view, const Theme& theme, const FieldLayers& layers);

    /// What does not change from tick to tick: floor, markings, goals, walls, grid.
    void place(const Environment& environment);
    /// Bodies and all layers.
    void frame(const FieldFrame& frame, const FieldFocus& focus);
    /// A scale bar in the lower left corner.
    void ruler();
    /// A distance measured by hand.
    void measure(const Point& from, const Point& to);

private:
    void grid();
    void trails(const FieldFrame& frame);
    void sensors(const FieldFrame& frame, const FieldFocus& focus);
    void ghosts(const FieldFrame& frame);
    void predicted(const FieldFrame& frame, const FieldFocus& focus);
    void bodies(const FieldFrame& frame, const FieldFocus& focus);
    void beliefs(const FieldFrame& frame, const FieldFocus& focus);
    void notes(const FieldFrame& frame, const FieldFocus& focus);
    void contacts(const FieldFrame& frame);
    void kicks(const FieldFrame& frame);
    void names(const FieldFrame& frame, const FieldFocus& focus);

    void shape(const Shape& shape, const Pose& pose, bool detailed);
    void outline(const Shape& shape, const Pose& pose, const QPen& pen);
    void heading(const Shape& shape, const Pose& pose, const QColor& colour);
    void polyline(const std::vector<Point>& points, const QPen& pen);
    void arrow(const QPointF& from, const QPointF& to, const QColor& colour, double width);
    void label(const QPointF& at, const QString& text, const QColor& colour, Qt::Alignment where);
    bool visible(const Point& at, double reach) const;
    QPolygonF mapped(const Polygon& polygon, const Placement& at) const;

    QPainter& painter_;
    const ViewTransform& view_;
    const Theme& theme_;
    const FieldLayers& layers_;
    FieldArea shown_;
};

/// "3.2 m", "45 cm": of a length between two digits and three.
QString lengthText(double metres);

}  // namespace mrose
