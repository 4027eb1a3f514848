#pragma once

#include <QPainter>

#include "debug/trails.h"
#include "geometry/shape.h"
#include "widgets/theme.h"
#include "widgets/view_transform.h"
#include "widgets/way_line.h"

namespace mrose {

/// A pen of one device pixel whatever the scale: fast, where there is much to draw.
QPen hairline(const QColor& colour, Qt::PenStyle style = Qt::SolidLine);
QPen roundPen(const QColor& colour, double width, Qt::PenStyle style = Qt::SolidLine);
/// Of a motion model: its colour and its dashes.
QPen modelPen(std::size_t model, double width);
QColor withAlpha(QColor colour, int alpha);

/// What all parts of the field's picture are drawn with: a painter in pixels, and where metres lie in them.
struct FieldCanvas {
    QPainter& painter;
    const ViewTransform& view;
    const Theme& theme;
    Area shown = view.shown();

    QPointF at(const Point& metres) const { return view.toPixels(metres); }
    double pixels(double metres) const { return metres * view.scale(); }
    bool visible(const Point& middle, double reach) const;
    QPolygonF mapped(const Polygon& polygon, const Placement& at) const;

    void shape(const Shape& shape, const Pose& pose, bool edged) const;
    /// Its parts with the present pen and brush.
    void parts(const Shape& shape, const Pose& pose) const;
    void outline(const Shape& shape, const Pose& pose, const QPen& pen) const;
    /// A line that is seen on any ground: its colour in a casing that sets it off.
    void casedLine(const QPolygonF& line, const QPen& pen) const;
    void casedLine(const QPointF& from, const QPointF& to, const QPen& pen) const;
    void arrow(const QPointF& from, const QPointF& to, const QColor& colour, double width) const;
    /// Where a body faces.
    void heading(const Shape& shape, const Pose& pose, const QColor& colour) const;
    /// A cross in a ring: a point that a controller goes to or looks at. What lies there, of a radius in pixels, is not
    /// covered.
    void target(const QPointF& at, const QColor& colour, double width, double clear = 0) const;
};

/// m, from the reference point to the foremost point.
double frontOf(const Shape& shape);

}  // namespace mrose
