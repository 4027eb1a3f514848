#include "widgets/field_painter.h"

#include <QObject>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "debug/placement.h"
#include "debug/real_robot.h"
#include "drawing/axis_ticks.h"
#include "widgets/field_readout.h"
#include "widgets/layer_sample.h"
#include "widgets/qt_text.h"

namespace mrose {
namespace {

struct LegendRow {
    FieldLayer layer;
    QString text;
    std::optional<std::size_t> model = {};
};

/// Of a layer that draws nothing without a reality none; of models one each.
std::vector<LegendRow> legendRows(const FieldFrame& frame, const FieldLayers& layers) {
    std::vector<LegendRow> rows;
    for (const FieldLayerText& text : fieldLayerTexts) {
        if (!layers.has(text.layer) || !hasSample(text.layer)) continue;
        const bool models = text.layer == FieldLayer::models;
        if (!models && (text.layer != FieldLayer::reality || frame.reality))
            rows.push_back({text.layer, QObject::tr(text.name)});
        for (std::size_t m = 0; models && frame.reality && m < frame.reality->models.size(); ++m)
            rows.push_back({text.layer, qtText(frame.reality->models[m].name), m});
    }
    return rows;
}

constexpr double legendSampleWidth = 34, legendMargin = 10, aboveScale = 20;  // pixels
constexpr double mostLegendRow = 20, leastLegendRow = 14, mostLegendShare = 0.6;

/// Rows in columns, so that it is no higher than a share of the picture.
struct LegendGrid {
    std::vector<LegendRow> rows;
    std::size_t inColumn = 1;
    double rowHeight = mostLegendRow, columnWidth = 0;

    LegendGrid(const FieldCanvas& canvas, const FieldFrame& frame, const FieldLayers& layers)
        : rows(legendRows(frame, layers)) {
        const QFontMetricsF metrics(plateFont(canvas.painter));
        for (const LegendRow& row : rows) columnWidth = std::max(columnWidth, metrics.horizontalAdvance(row.text));
        columnWidth += legendSampleWidth + 2 * legendMargin;
        const double room = mostLegendShare * canvas.view.size().height() - legendMargin;
        rowHeight = std::clamp(room / static_cast<double>(std::max<std::size_t>(1, rows.size())), leastLegendRow,
                               mostLegendRow);
        const auto fitting = static_cast<std::size_t>(std::max(1.0, room / rowHeight));
        inColumn = std::clamp<std::size_t>(fitting, 1, std::max<std::size_t>(1, rows.size()));
        inColumn = (rows.size() + columns() - 1) / std::max<std::size_t>(1, columns());
    }
    std::size_t columns() const { return (rows.size() + inColumn - 1) / inColumn; }
    QSizeF size() const {
        return {columnWidth * static_cast<double>(columns()) + legendMargin,
                rowHeight * static_cast<double>(inColumn) + legendMargin};
    }
};

/// In the lower right corner, or above or beside what lies there, wherever it hides less of the place; empty where
/// there is nothing to explain.
QRectF legendBox(const FieldCanvas& canvas, const FieldFrame& frame, const FieldLayers& layers, const QRectF& covered) {
    const LegendGrid grid(canvas, frame, layers);
    if (grid.rows.empty()) return {};
    const QSizeF size = grid.size();
    const QSizeF all = canvas.view.size();
    const QRectF corner(QPointF(all.width() - size.width() - 12, all.height() - size.height() - 12), size);
    if (!corner.intersects(covered)) return corner;
    const QRectF above = corner.translated(0, covered.top() - 8 - corner.bottom());
    const QRectF aside = corner.translated(covered.left() - 8 - corner.right(), -aboveScale);
    const Area area = areaOf(frame.scene().environment);
    const QRectF place = canvas.view.box(area);
    const auto hidden = [&](const QRectF& box) {
        const QRectF common = box & place;
        return common.width() * common.height();
    };
    return aside.left() >= legendMargin && hidden(aside) < hidden(above) ? aside : above;
}

}  // namespace

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

Area areaOf(const FieldFrame& frame) {
    Area area = areaOf(frame.scene().environment);
    for (std::size_t body = 0; body < frame.scene().bodyCount(); ++body)
        area.include(position(frame.poseOf(body)), frame.scene().shapeOf(body).reach);
    if (frame.reality) area.include(areaOf(*frame.reality));
    return area;
}

FieldPainter::FieldPainter(QPainter& painter, const ViewTransform& view, const Theme& theme, const FieldLayers& layers)
    : canvas_{painter, view, theme}, layers_(layers) {}

void FieldPainter::place(const Environment& environment) {
    drawGround(canvas_, environment);
    if (layers_.has(FieldLayer::grid)) drawGrid(canvas_);
}

void FieldPainter::frame(const FieldFrame& frame, const FieldFocus& focus, LabelPlacer& placer) {
    std::vector<FieldLabel> labels;
    canvas_.painter.setRenderHint(QPainter::Antialiasing);
    if (layers_.has(FieldLayer::sensors)) drawSensors(canvas_, frame, focus);
    const bool real = layers_.has(FieldLayer::reality), models = layers_.has(FieldLayer::models);
    if (real && layers_.has(FieldLayer::trails)) drawRealWays(canvas_, frame, focus);
    if (models && layers_.has(FieldLayer::trails)) drawModelWays(canvas_, frame);
    if (layers_.has(FieldLayer::trails)) drawTrails(canvas_, frame, focus);
    if (layers_.has(FieldLayer::ghosts)) drawGhosts(canvas_, frame);
    if (layers_.has(FieldLayer::predicted)) drawPredicted(canvas_, frame, focus);
    drawBodies(canvas_, frame, layers_.has(FieldLayer::headings));
    if (models) drawModelRobots(canvas_, frame, layers_.has(FieldLayer::headings));
    if (real) drawRealRobots(canvas_, frame, layers_.has(FieldLayer::headings));
    drawFocus(canvas_, frame, focus);
    if (layers_.has(FieldLayer::names)) addNames(canvas_, frame, focus, labels);
    if (real && layers_.has(FieldLayer::names)) addRealNames(canvas_, frame, focus, labels);
    if (layers_.has(FieldLayer::beliefs)) drawBeliefs(canvas_, frame, focus);
    if (layers_.has(FieldLayer::contacts)) drawContacts(canvas_, frame, focus, labels);
    drawKicks(canvas_, frame, labels);
    if (layers_.has(FieldLayer::targets)) drawNotes(canvas_, frame, focus, labels);
    std::vector<QRectF> kept;
    if (layers_.has(FieldLayer::legend)) kept.push_back(legendBox(canvas_, frame, layers_, focus.covered));
    if (!focus.covered.isEmpty()) kept.push_back(focus.covered);
    kept.push_back(scaleBar().box());
    if (hasKnob(frame, focus)) kept.push_back(knobBox(canvas_.view, frame, *focus.selected));
    if (!focus.moved || !focus.selected) return drawLabels(canvas_, frame, std::move(labels), placer, kept);
    const auto [box, numbers] = moved(frame, *focus.selected, *focus.moved);
    kept.push_back(box);
    drawLabels(canvas_, frame, std::move(labels), placer, kept);
    drawPlate(canvas_, box, numbers);
}

/// Where a body is being moved to, in numbers above it.
std::pair<QRectF, FieldLabel> FieldPainter::moved(const FieldFrame& frame, std::size_t body, const Pose& pose) const {
    FieldLabel label;
    label.text = poseText(frame, body, pose);
    if (const std::string why = hindranceAt(frame, body, pose); !why.empty()) label.text += "   " + qtText(why);
    label.colour = canvas_.theme.onFloor;
    const QSizeF size = plateSize(canvas_, label), all = canvas_.view.size();
    const QPointF at = canvas_.at(position(pose));
    const double away = canvas_.pixels(frame.scene().shapeOf(body).reach) + 12;
    const double left = std::clamp(at.x() - size.width() / 2, 4.0, std::max(4.0, all.width() - size.width() - 4));
    const double above = at.y() - away - size.height();
    return {QRectF(QPointF(left, above > 4 ? above : at.y() + away), size), label};
}

void FieldPainter::corners(const FieldFrame& frame, const QRectF& covered) {
    ruler();
    if (layers_.has(FieldLayer::legend)) legend(frame, covered);
}

FieldPainter::ScaleBar FieldPainter::scaleBar() const {
    const double metres = roundStep(70 / canvas_.view.scale());
    const double x = layers_.has(FieldLayer::grid) ? rulerWidth + 16 : 16;
    const QPointF left(x, std::round(canvas_.view.size().height() - 13));
    FieldLabel label;
    label.text = lengthText(metres);
    label.colour = canvas_.theme.onFloor;
    const QSizeF size = plateSize(canvas_, label);
    const QPointF right = left + QPointF(canvas_.pixels(metres), 0);
    return {left, right, label, {right + QPointF(6, -size.height() / 2), size}};
}

void FieldPainter::ruler() {
    const auto [left, right, label, plate] = scaleBar();
    QPainter& painter = canvas_.painter;
    painter.setRenderHint(QPainter::Antialiasing, false);
    for (const QPen& pen : {QPen(canvas_.theme.halo, 4), QPen(canvas_.theme.text, 1)}) {
        painter.setPen(pen);
        painter.drawLine(left, right);
        painter.drawLine(left - QPointF(0, 4), left + QPointF(0, 4));
        painter.drawLine(right - QPointF(0, 4), right + QPointF(0, 4));
    }
    painter.setRenderHint(QPainter::Antialiasing);
    drawPlate(canvas_, plate, label);
}

void FieldPainter::legend(const FieldFrame& frame, const QRectF& covered) {
    const LegendGrid grid(canvas_, frame, layers_);
    if (grid.rows.empty()) return;
    constexpr double sampleWidth = legendSampleWidth, margin = legendMargin;
    QPainter& painter = canvas_.painter;
    const QRectF box = legendBox(canvas_, frame, layers_, covered);
    painter.setPen(roundPen(canvas_.theme.line, 1));
    painter.setBrush(withAlpha(canvas_.theme.panel, 235));
    painter.drawRoundedRect(box, 5, 5);
    for (std::size_t i = 0; i < grid.rows.size(); ++i) {
        const LegendRow& one = grid.rows[i];
        const std::size_t column = i / grid.inColumn, row = i % grid.inColumn;
        const double left = box.left() + margin + grid.columnWidth * static_cast<double>(column);
        const double top = box.top() + margin / 2 + grid.rowHeight * static_cast<double>(row);
        const QRectF sample(left, top + 2, sampleWidth, grid.rowHeight - 4);
        if (one.model)
            drawModelSample(painter, sample, *one.model);
        else
            drawSample(painter, sample, one.layer, canvas_.theme);
        painter.setFont(plateFont(painter));
        painter.setPen(canvas_.theme.text);
        painter.drawText(
            QRectF(left + sampleWidth + margin, top, grid.columnWidth - sampleWidth - margin, grid.rowHeight),
            Qt::AlignLeft | Qt::AlignVCenter, one.text);
    }
}

void FieldPainter::measure(const Point& from, const Point& to) {
    const QPointF a = canvas_.at(from), b = canvas_.at(to);
    QPainter& painter = canvas_.painter;
    for (const QPen& pen : {roundPen(canvas_.theme.halo, 4), roundPen(canvas_.theme.accent, 2)}) {
        painter.setPen(pen);
        painter.drawLine(a, b);
    }
    const Point along = to - from;
    const double degrees = std::atan2(along.y, along.x) * 180 / std::numbers::pi;
    FieldLabel label;
    label.text = lengthText(length(along)) + "   " + QString::number(degrees, 'f', 1) + QString::fromUtf8("\u00b0");
    label.colour = canvas_.theme.onFloor;
    const QSizeF size = plateSize(canvas_, label);
    const double left = std::min(b.x() + 10, canvas_.view.size().width() - size.width() - 4);
    drawPlate(canvas_, {QPointF(left, std::max(4.0, b.y() - 10 - size.height())), size}, label);
}

}  // namespace mrose
