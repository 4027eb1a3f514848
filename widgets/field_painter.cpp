#include "widgets/field_painter.h"

#include <QObject>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "debug/placement.h"
#include "debug/real_robot.h"
#include "drawing/axis_ticks.h"
#include "widgets/field_legend.h"
#include "widgets/field_readout.h"
#include "widgets/qt_text.h"

namespace mrose {

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

void FieldPainter::frame(const FieldFrame& frame, const FieldFocus& focus, LabelPlacer& placer, FieldLegend& legend) {
    std::vector<FieldLabel> labels;
    canvas_.painter.setRenderHint(QPainter::Antialiasing);
    if (layers_.has(FieldLayer::sensors)) drawSensors(canvas_, frame, focus);
    const std::vector<RobotScans> scans = shownScans(frame, layers_, focus);
    drawScanAreas(canvas_, frame, focus, scans);
    const bool real = layers_.has(FieldLayer::reality), models = layers_.has(FieldLayer::models);
    if (real && layers_.has(FieldLayer::trails)) drawRealWays(canvas_, frame, focus);
    if (models && layers_.has(FieldLayer::trails)) drawModelWays(canvas_, frame);
    if (layers_.has(FieldLayer::trails)) drawTrails(canvas_, frame, focus);
    if (layers_.has(FieldLayer::ghosts)) drawGhosts(canvas_, frame);
    if (layers_.has(FieldLayer::predicted)) drawPredicted(canvas_, frame, focus);
    const std::vector<RobotLooks> looks = shownLooks(frame, layers_, focus);
    drawRays(canvas_, frame, focus, looks);
    if (layers_.has(FieldLayer::radio)) drawRadio(canvas_, frame, focus);
    drawBodies(canvas_, frame, layers_.has(FieldLayer::headings));
    // Above them: that of slow robots is no longer than they are.
    if (layers_.has(FieldLayer::uncertainty)) drawBands(canvas_, frame, focus);
    if (models) drawModelRobots(canvas_, frame, layers_.has(FieldLayer::headings));
    if (real) drawRealRobots(canvas_, frame, layers_.has(FieldLayer::headings));
    if (layers_.has(FieldLayer::uncertainty)) drawRegionsNow(canvas_, frame, focus);
    drawScanMarks(canvas_, frame, focus, scans);
    drawFocus(canvas_, frame, focus);
    drawReadings(canvas_, frame, focus, looks);
    if (layers_.has(FieldLayer::names)) addNames(canvas_, frame, focus, labels);
    if (real && layers_.has(FieldLayer::names)) addRealNames(canvas_, frame, focus, labels);
    if (layers_.has(FieldLayer::beliefs)) drawBeliefs(canvas_, frame, focus);
    if (layers_.has(FieldLayer::contacts)) drawContacts(canvas_, frame, focus, labels);
    drawKicks(canvas_, frame, labels);
    if (layers_.has(FieldLayer::targets)) drawNotes(canvas_, frame, focus, labels);
    std::vector<QRectF> kept;
    if (layers_.has(FieldLayer::legend)) {
        legend.arrange(canvas_, frame, layers_, focus);
        kept.push_back(legend.box());
    }
    if (!focus.covered.isEmpty()) kept.push_back(focus.covered);
    kept.push_back(scaleBar().box());
    if (hasKnob(frame, focus)) kept.push_back(knobBox(canvas_.view, frame, *focus.selected));
    if (layers_.has(FieldLayer::uncertainty))
        if (const auto ahead = bandLabel(canvas_, frame, focus);
            ahead &&
            std::none_of(kept.begin(), kept.end(), [&](const auto& box) { return box.intersects(ahead->box); })) {
            kept.push_back(ahead->box);
            drawPlate(canvas_, ahead->box, ahead->label);
        }
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

void FieldPainter::corners(const FieldFrame& frame, const FieldLegend& legend) {
    ruler();
    if (layers_.has(FieldLayer::legend)) legend.draw(canvas_, frame);
}

FieldPainter::ScaleBar FieldPainter::scaleBar() const {
    const double metres = roundStep(70 / canvas_.view.scale());
    const double x = layers_.has(FieldLayer::grid) ? rulerWidth + 16 : 16;
    const QPointF left(x, std::round(canvas_.view.size().height() - 13));
    FieldLabel label;
    label.text = lengthText(metres);
    if (canvas_.view.turned()) label.text += QObject::tr(", turned: x up, y left");
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
