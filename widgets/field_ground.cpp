#include <algorithm>
#include <cmath>
#include <functional>

#include "drawing/axis_ticks.h"
#include "widgets/field_drawing.h"

namespace mrose {
namespace {

QString metresText(double value, double step) {
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    return QString::number(std::abs(value) < step / 2 ? 0 : value, 'f', decimals);
}

void drawMarking(const FieldCanvas& canvas, const Marking& marking) {
    QPainter& painter = canvas.painter;
    QPen pen(toQColor(marking.colour), std::max(1.0, canvas.pixels(marking.width)));
    pen.setCapStyle(Qt::FlatCap);
    pen.setJoinStyle(Qt::MiterJoin);
    painter.setPen(pen);
    painter.setBrush(Qt::NoBrush);
    if (marking.radius > 0)
        painter.drawEllipse(canvas.at(marking.centre), canvas.pixels(marking.radius), canvas.pixels(marking.radius));
    else if (marking.closed)
        painter.drawPolygon(canvas.mapped(marking.points, {}));
    else
        painter.drawPolyline(canvas.mapped(marking.points, {}));
}

/// Of the picture: the field's coordinates that run along it, and where each lies.
struct Axis {
    double least = 0, most = 0;
    std::function<double(double)> at;
};

Axis across(const FieldCanvas& canvas) {
    if (canvas.view.turned())
        return {canvas.shown.least.y, canvas.shown.most.y, [&](double y) { return canvas.at({0, y}).x(); }};
    return {canvas.shown.least.x, canvas.shown.most.x, [&](double x) { return canvas.at({x, 0}).x(); }};
}

Axis down(const FieldCanvas& canvas) {
    if (canvas.view.turned())
        return {canvas.shown.least.x, canvas.shown.most.x, [&](double x) { return canvas.at({x, 0}).y(); }};
    return {canvas.shown.least.y, canvas.shown.most.y, [&](double y) { return canvas.at({0, y}).y(); }};
}

template <class Draw>
void forEachStep(const Axis& axis, double step, Draw draw) {
    const auto last = static_cast<std::int64_t>(std::floor(axis.most / step + 1e-9));
    for (auto i = static_cast<std::int64_t>(std::ceil(axis.least / step - 1e-9)); i <= last; ++i)
        draw(static_cast<double>(i) * step, axis.at(static_cast<double>(i) * step));
}

void drawRulers(const FieldCanvas& canvas, double step) {
    QPainter& painter = canvas.painter;
    const double width = canvas.view.size().width(), height = canvas.view.size().height();
    QColor ground = canvas.theme.panel;
    ground.setAlpha(225);
    painter.fillRect(QRectF(0, 0, width, rulerHeight), ground);
    painter.fillRect(QRectF(0, rulerHeight, rulerWidth, height - rulerHeight), ground);
    painter.setPen(hairline(canvas.theme.line));
    painter.drawLine(QPointF(0, rulerHeight), QPointF(width, rulerHeight));
    painter.drawLine(QPointF(rulerWidth, rulerHeight), QPointF(rulerWidth, height));
    QFont font = painter.font();
    font.setPointSizeF(8);
    painter.setFont(font);
    painter.setPen(canvas.theme.quietText);
    forEachStep(across(canvas), step, [&](double value, double at) {
        if (at < rulerWidth + 14) return;
        painter.drawLine(QPointF(at, rulerHeight - 4), QPointF(at, rulerHeight));
        painter.drawText(QRectF(at - 30, 0, 60, rulerHeight - 3), Qt::AlignCenter, metresText(value, step));
    });
    forEachStep(down(canvas), step, [&](double value, double at) {
        if (at < rulerHeight + 8) return;
        painter.drawLine(QPointF(rulerWidth - 4, at), QPointF(rulerWidth, at));
        painter.drawText(QRectF(0, at - 8, rulerWidth - 6, 16), Qt::AlignRight | Qt::AlignVCenter,
                         metresText(value, step));
    });
    painter.drawText(QRectF(0, 0, rulerWidth, rulerHeight), Qt::AlignCenter, "m");
}

}  // namespace

QColor floorColour(const Environment& environment, const Theme& theme) {
    // A dark room does not want a bright floor.
    const QColor floor = toQColor(environment.floor.colour);
    return theme.dark ? floor.darker(170) : floor;
}

void drawGround(const FieldCanvas& canvas, const Environment& environment) {
    QPainter& painter = canvas.painter;
    painter.fillRect(QRectF(QPointF(0, 0), canvas.view.size()), canvas.theme.surround);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(floorColour(environment, canvas.theme));
    painter.drawPolygon(canvas.mapped(environment.floor.area, {}));
    painter.setBrush(QColor(255, 255, 255, 40));
    for (const Goal& goal : environment.goals) painter.drawPolygon(canvas.mapped(goal.area, {}));
    for (const Marking& marking : environment.markings) drawMarking(canvas, marking);
    for (const Obstacle& obstacle : environment.obstacles) canvas.shape(obstacle.shape, {}, true);
}

void drawGrid(const FieldCanvas& canvas) {
    const double step = roundStep(48 / canvas.view.scale());
    QPainter& painter = canvas.painter;
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setPen(hairline(withAlpha(canvas.theme.dark ? QColor(255, 255, 255) : QColor(0, 0, 0), 42)));
    const double width = canvas.view.size().width(), height = canvas.view.size().height();
    forEachStep(across(canvas), step,
                [&](double, double at) { painter.drawLine(QPointF(at, 0), QPointF(at, height)); });
    forEachStep(down(canvas), step, [&](double, double at) { painter.drawLine(QPointF(0, at), QPointF(width, at)); });
    drawRulers(canvas, step);
    painter.setRenderHint(QPainter::Antialiasing);
}

Area areaOf(const Environment& environment) {
    Area area{{1, 1}, {-1, -1}};
    for (const Point& corner : environment.floor.area) area.include(corner);
    for (const Obstacle& obstacle : environment.obstacles)
        for (const ConvexPiece& piece : obstacle.shape.pieces)
            for (std::size_t i = 0; i < piece.count; ++i) area.include(piece.corners[i], piece.radius);
    for (const Marking& marking : environment.markings) {
        for (const Point& point : marking.points) area.include(point);
        if (marking.radius > 0) area.include(marking.centre, marking.radius);
    }
    return area;
}

}  // namespace mrose
