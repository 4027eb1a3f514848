#include <algorithm>
#include <array>
#include <cmath>

#include "debug/placement.h"
#include "simulation/driving_now.h"
#include "widgets/field_drawing.h"
#include "widgets/field_readout.h"

namespace mrose {
namespace {

/// Bodies smaller than this (pixels) are dots.
constexpr double leastDetail = 5;

constexpr double ringGap = 6, elsewhereGap = 3, knobStalk = 8;  // pixels

/// A body that is too small for its shape: in its robot's colour, with a line to where it faces.
void drawDot(const FieldCanvas& canvas, const FieldFrame& frame, std::size_t body, double reach, bool heading) {
    const bool robot = body < frame.state.robots.size();
    const Pose& pose = frame.poseOf(body);
    const QPointF at = canvas.at(position(pose));
    const double radius = std::max(2.0, canvas.pixels(reach));
    const QColor colour =
        robot ? robotColour(frame.scene(), body) : toQColor(frame.scene().shapeOf(body).parts.front().colour);
    canvas.painter.setPen(Qt::NoPen);
    canvas.painter.setBrush(colour);
    canvas.painter.drawRect(QRectF(at - QPointF(radius, radius), QSizeF(2 * radius, 2 * radius)));
    if (!robot || !heading || radius < 2.5) return;
    canvas.painter.setPen(hairline(QColor(0, 0, 0)));
    canvas.painter.drawLine(at, at + 1.8 * radius * canvas.view.along(pose.heading));
}

/// The colour that a robot is known by, as a rim about its body's own colours.
void drawRim(const FieldCanvas& canvas, const FieldFrame& frame, std::size_t body) {
    const Shape& shape = frame.scene().shapeOf(body);
    const double width = std::clamp(0.14 * canvas.pixels(shape.reach), 1.5, 4.0);
    const QColor colour = robotColour(frame.scene(), body);
    canvas.outline(shape, frame.poseOf(body), roundPen(withAlpha(setOff(colour), 150), 2 * width + 2));
    canvas.outline(shape, frame.poseOf(body), roundPen(colour, 2 * width));
}

void ring(const FieldCanvas& canvas, const FieldFrame& frame, std::size_t body, const QColor& colour, double width) {
    const double radius = canvas.pixels(frame.scene().shapeOf(body).reach) + ringGap;
    canvas.painter.setBrush(Qt::NoBrush);
    for (const QPen& pen : {roundPen(canvas.theme.halo, width + 2), roundPen(colour, width)}) {
        canvas.painter.setPen(pen);
        canvas.painter.drawEllipse(canvas.at(position(frame.poseOf(body))), radius, radius);
    }
}

/// Of a robot that is driven as its network has not learned: its prediction is a guess.
void drawUnfamiliar(const FieldCanvas& canvas, const FieldFrame& frame, std::size_t robot) {
    const DrivingReader* const reader = familiarDriving(frame.scene(), robot);
    if (reader == nullptr || !reader->isUnfamiliar(drivingNow(*frame.scenario, frame.state, robot))) return;
    const double radius = canvas.pixels(frame.scene().shapeOf(robot).reach) + elsewhereGap;
    canvas.painter.setBrush(Qt::NoBrush);
    for (const QPen& pen : {roundPen(canvas.theme.halo, 4), roundPen(canvas.theme.warning, 2, Qt::DashLine)}) {
        canvas.painter.setPen(pen);
        canvas.painter.drawEllipse(canvas.at(position(frame.poseOf(robot))), radius, radius);
    }
}

/// A thin ring, and a line to where the body is in the other branch.
void drawElsewhere(const FieldCanvas& canvas, const FieldFrame& frame, std::size_t body, const Point& there) {
    const Pose& pose = frame.poseOf(body);
    const double radius = canvas.pixels(frame.scene().shapeOf(body).reach) + elsewhereGap;
    const QPointF from = canvas.at(position(pose)), along = canvas.at(there) - from;
    const double size = std::hypot(along.x(), along.y());
    canvas.painter.setBrush(Qt::NoBrush);
    for (const QPen& pen : {roundPen(canvas.theme.halo, 3), roundPen(canvas.theme.onFloor, 1.2)}) {
        canvas.painter.setPen(pen);
        canvas.painter.drawEllipse(from, radius, radius);
    }
    if (size > radius)
        canvas.casedLine(from + radius / size * along, canvas.at(there), roundPen(canvas.theme.onFloor, 1.2));
}

void drawKnob(const FieldCanvas& canvas, const FieldFrame& frame, std::size_t robot) {
    const QPointF at = knobAt(canvas.view, frame, robot), from = canvas.at(position(frame.poseOf(robot)));
    const QPointF along = (at - from) / std::max(1.0, QLineF(from, at).length());
    canvas.casedLine(at - (knobStalk + knobRadius) * along, at - knobRadius * along,
                     roundPen(canvas.theme.accent, 1.6));
    canvas.painter.setPen(roundPen(canvas.theme.accent, 1.6));
    canvas.painter.setBrush(canvas.theme.panel);
    canvas.painter.drawEllipse(at, knobRadius, knobRadius);
}

void drawMoved(const FieldCanvas& canvas, const FieldFrame& frame, std::size_t body, const Pose& to) {
    const Shape& shape = frame.scene().shapeOf(body);
    const QColor colour = hindranceAt(frame, body, to).empty() ? canvas.theme.accent : canvas.theme.warning;
    canvas.painter.setBrush(withAlpha(colour, 60));
    canvas.painter.setPen(roundPen(colour, 1.6));
    canvas.parts(shape, to);
    if (body < frame.state.robots.size()) canvas.heading(shape, to, colour);
    const Pose& from = frame.poseOf(body);
    if (length(position(to) - position(from)) * canvas.view.scale() < 8) return;
    canvas.casedLine(canvas.at(position(from)), canvas.at(position(to)), roundPen(colour, 1.2, Qt::DashLine));
}

}  // namespace

bool FieldFocus::isQuiet(std::size_t body) const {
    const bool looked = selected == body || hovered == body;
    return !lit.empty() && !looked && std::find(lit.begin(), lit.end(), body) == lit.end();
}

bool hasKnob(const FieldFrame& frame, const FieldFocus& focus) {
    return focus.turnable && !focus.moved && focus.selected && *focus.selected < frame.state.robots.size();
}

QPointF knobAt(const ViewTransform& view, const FieldFrame& frame, std::size_t robot) {
    const Pose& pose = frame.poseOf(robot);
    const double away = view.scale() * frame.scene().shapeOf(robot).reach + ringGap + knobStalk + knobRadius;
    return view.toPixels(position(pose)) + away * view.along(pose.heading);
}

QRectF knobBox(const ViewTransform& view, const FieldFrame& frame, std::size_t robot) {
    return QRectF(-knobRadius, -knobRadius, 2 * knobRadius, 2 * knobRadius).translated(knobAt(view, frame, robot));
}

std::vector<std::size_t> visibleBodies(const FieldCanvas& canvas, const FieldFrame& frame) {
    std::vector<std::size_t> bodies;
    for (std::size_t body = 0; body < frame.scene().bodyCount(); ++body)
        if (canvas.visible(position(frame.poseOf(body)), frame.scene().shapeOf(body).reach)) bodies.push_back(body);
    return bodies;
}

void drawBodies(const FieldCanvas& canvas, const FieldFrame& frame, bool headings) {
    const std::vector<std::size_t> bodies = visibleBodies(canvas, frame);
    const bool many = bodies.size() > mostSmooth;
    canvas.painter.setRenderHint(QPainter::Antialiasing, !many);
    // Objects under robots would be hidden: they come last.
    for (const std::size_t body : bodies) {
        const Shape& shape = frame.scene().shapeOf(body);
        const bool robot = body < frame.state.robots.size();
        if (canvas.pixels(shape.reach) < leastDetail) {
            drawDot(canvas, frame, body, shape.reach, headings);
            continue;
        }
        if (robot && !many) drawRim(canvas, frame, body);
        if (robot) drawUnfamiliar(canvas, frame, body);
        canvas.shape(shape, frame.poseOf(body), !many);
        if (!robot) continue;
        if (headings)
            canvas.heading(shape, frame.poseOf(body), many ? robotColour(frame.scene(), body) : QColor(255, 255, 255));
    }
    canvas.painter.setRenderHint(QPainter::Antialiasing);
}

void drawFocus(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus) {
    const std::size_t count = frame.scene().bodyCount();
    for (std::size_t body = 0; body < std::min(count, focus.elsewhere.size()); ++body)
        if (focus.elsewhere[body]) drawElsewhere(canvas, frame, body, *focus.elsewhere[body]);
    if (focus.hovered && *focus.hovered < count && focus.hovered != focus.selected)
        ring(canvas, frame, *focus.hovered, withAlpha(canvas.theme.accent, 150), 1);
    if (!focus.selected || *focus.selected >= count) return;
    ring(canvas, frame, *focus.selected, canvas.theme.accent, 2);
    if (hasKnob(frame, focus)) drawKnob(canvas, frame, *focus.selected);
    if (focus.moved) drawMoved(canvas, frame, *focus.selected, *focus.moved);
}

}  // namespace mrose
