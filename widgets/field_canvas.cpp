#include "widgets/field_canvas.h"

#include <algorithm>
#include <cmath>

namespace mrose {

QPen hairline(const QColor& colour, Qt::PenStyle style) {
    QPen pen(colour, 1, style);
    pen.setCosmetic(true);
    return pen;
}

QPen roundPen(const QColor& colour, double width, Qt::PenStyle style) {
    return {colour, width, style, style == Qt::SolidLine ? Qt::RoundCap : Qt::FlatCap, Qt::RoundJoin};
}

QPen modelPen(std::size_t model, double width) {
    const QVector<qreal> dashes = modelDashes(model);
    QPen pen = roundPen(modelColour(model), width, dashes.isEmpty() ? Qt::SolidLine : Qt::CustomDashLine);
    if (!dashes.isEmpty()) pen.setDashPattern(dashes);
    return pen;
}

QColor withAlpha(QColor colour, int alpha) {
    colour.setAlpha(alpha);
    return colour;
}

double frontOf(const Shape& shape) {
    double most = 0;
    for (const ConvexPiece& piece : shape.pieces)
        for (std::size_t i = 0; i < piece.count; ++i) most = std::max(most, piece.corners[i].x + piece.radius);
    return most;
}

bool FieldCanvas::visible(const Point& middle, double reach) const {
    return middle.x + reach >= shown.least.x && middle.x - reach <= shown.most.x && middle.y + reach >= shown.least.y &&
           middle.y - reach <= shown.most.y;
}

QPolygonF FieldCanvas::mapped(const Polygon& polygon, const Placement& placement) const {
    QPolygonF points;
    points.reserve(static_cast<int>(polygon.size()));
    for (const Point& corner : polygon) points.append(at(placement.place(corner)));
    return points;
}

void FieldCanvas::shape(const Shape& shape, const Pose& pose, bool edged) const {
    const Placement placement(pose);
    for (const ShapePart& part : shape.parts) {
        const QColor fill = toQColor(part.colour);
        painter.setBrush(fill);
        painter.setPen(edged ? roundPen(fill.darker(160), 1) : QPen(Qt::NoPen));
        if (part.polygon.empty())
            painter.drawEllipse(at(placement.place(part.centre)), pixels(part.radius), pixels(part.radius));
        else
            painter.drawPolygon(mapped(part.polygon, placement));
    }
}

void FieldCanvas::parts(const Shape& shape, const Pose& pose) const {
    const Placement placement(pose);
    for (const ShapePart& part : shape.parts) {
        if (part.polygon.empty())
            painter.drawEllipse(at(placement.place(part.centre)), pixels(part.radius), pixels(part.radius));
        else
            painter.drawPolygon(mapped(part.polygon, placement));
    }
}

void FieldCanvas::outline(const Shape& shape, const Pose& pose, const QPen& pen) const {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(pen);
    parts(shape, pose);
}

void FieldCanvas::casedLine(const QPolygonF& line, const QPen& pen) const {
    QPen casing = pen;
    casing.setColor(withAlpha(setOff(pen.color()), pen.color().alpha() / 2));
    casing.setWidthF(pen.widthF() + 1.6);
    casing.setStyle(Qt::SolidLine);
    painter.setPen(casing);
    painter.drawPolyline(line);
    painter.setPen(pen);
    painter.drawPolyline(line);
}

void FieldCanvas::casedLine(const QPointF& from, const QPointF& to, const QPen& pen) const {
    casedLine(QPolygonF(QVector<QPointF>{from, to}), pen);
}

void FieldCanvas::arrow(const QPointF& from, const QPointF& to, const QColor& colour, double width) const {
    const QPointF along = to - from;
    const double size = std::hypot(along.x(), along.y());
    if (size < 1) return;
    const QPointF unit = along / size, across(-unit.y(), unit.x());
    const double head = std::min(size, 3.2 * width);
    const QPointF neck = to - head * unit;
    const QPolygonF polygon({from + width / 2 * across, neck + width / 2 * across, neck + 1.6 * width * across, to,
                             neck - 1.6 * width * across, neck - width / 2 * across, from - width / 2 * across});
    painter.setBrush(colour);
    painter.setPen(roundPen(withAlpha(setOff(colour), 200), 1));
    painter.drawPolygon(polygon);
}

void FieldCanvas::heading(const Shape& shape, const Pose& pose, const QColor& colour) const {
    const double front = std::max(frontOf(shape), 0.5 * shape.reach);
    const Placement placement(pose);
    arrow(at(placement.place({-0.45 * front, 0})), at(placement.place({0.95 * front, 0})), colour,
          std::clamp(0.16 * pixels(front), 1.5, 9.0));
}

void FieldCanvas::target(const QPointF& at, const QColor& colour, double width, double clear) const {
    const double radius = std::max(5.0, clear + 2), begin = clear > 0 ? radius : 2;
    painter.setBrush(Qt::NoBrush);
    for (const bool casing : {true, false}) {
        painter.setPen(casing ? roundPen(withAlpha(setOff(colour), colour.alpha() / 2), width + 1.6)
                              : roundPen(colour, width));
        painter.drawEllipse(at, radius, radius);
        for (const QPointF& side : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
            painter.drawLine(at + begin * side, at + (radius + 3) * side);
    }
}

}  // namespace mrose
