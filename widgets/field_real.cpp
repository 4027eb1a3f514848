#include <QObject>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "logs/pose_grid.h"
#include "widgets/field_drawing.h"
#include "widgets/qt_text.h"
#include "widgets/real_readout.h"

namespace mrose {
namespace {

/// How far ahead the real trajectory is shown.
constexpr Nanoseconds ahead = 2 * nanosecondsPerSecond;
constexpr double wayWidth = 5, wayHollow = 2.6;  // pixels
/// Robots nearer than this (pixels; m) to their simulated ones have no line to them.
constexpr double leastErrorPixels = 5, leastError = 0.01;
constexpr double focusRing = 7;  // pixels, about a body that is selected

/// How far back trails reach in this frame.
Nanoseconds trailSpan(const FieldFrame& frame) {
    const auto ticks = static_cast<std::int64_t>(frame.trails.ticks());
    return std::min(frame.state.tick, std::max<std::int64_t>(0, ticks - 1)) * frame.scene().tickLength;
}

/// Gaps in the truth are gaps in the line.
QVector<QPolygonF> wayBetween(const FieldCanvas& canvas, const Reality::Robot& robot, Nanoseconds from,
                              Nanoseconds to) {
    WayLine way;
    Nanoseconds before = 0;
    const auto add = [&](Nanoseconds time, const Pose& pose) {
        if (time - before >= truthGap) way.begin();
        way.add(canvas.at(position(pose)));
        before = time;
    };
    if (const auto pose = robot.poseAt(from)) add(robot.origin + from, *pose);
    for (const StampedPose& stamped : robot.posesBetween(from, to)) add(stamped.time, stamped.pose);
    if (const auto pose = robot.poseAt(to)) add(robot.origin + to, *pose);
    return way.lines();
}

/// Two thin lines beside each other, as an outline is a thin line about a body.
void drawHollow(const FieldCanvas& canvas, const QVector<QPolygonF>& lines, const QColor& colour, const QColor& floor) {
    for (const bool inside : {false, true}) {
        QPen pen = roundPen(inside ? floor : colour, inside ? wayHollow : wayWidth);
        pen.setCapStyle(Qt::FlatCap);
        pen.setJoinStyle(Qt::BevelJoin);
        canvas.painter.setPen(pen);
        for (const QPolygonF& line : lines) canvas.painter.drawPolyline(line);
    }
}

/// A line from a body's middle to its front, with a head of two strokes: hollow, as the body is.
void drawNose(const FieldCanvas& canvas, const Shape& shape, const Pose& pose, const QPen& pen, bool head) {
    const double front = std::max(frontOf(shape), 0.5 * shape.reach);
    const Placement placement(pose);
    const auto at = [&](double x, double y) { return canvas.at(placement.place({x * front, y * front})); };
    canvas.painter.setPen(pen);
    canvas.painter.setBrush(Qt::NoBrush);
    canvas.painter.drawLine(at(0, 0), at(1, 0));
    if (head && canvas.pixels(front) >= 8)
        canvas.painter.drawPolyline(QPolygonF(QVector<QPointF>{at(0.55, 0.4), at(1, 0), at(0.55, -0.4)}));
}

/// All parts of a shape as one.
QPainterPath silhouette(const FieldCanvas& canvas, const Shape& shape, const Pose& pose) {
    const Placement placement(pose);
    QPainterPath whole;
    for (const ShapePart& part : shape.parts) {
        QPainterPath path;
        if (part.polygon.empty())
            path.addEllipse(canvas.at(placement.place(part.centre)), canvas.pixels(part.radius),
                            canvas.pixels(part.radius));
        else
            path.addPolygon(canvas.mapped(part.polygon, placement));
        path.closeSubpath();
        whole = whole.isEmpty() ? path : whole.united(path);
    }
    return whole;
}

/// Of a model between the instants that it has: it is to be seen going on, as the others are.
std::optional<Pose> modelPose(const Reality::ModelRollout& model, std::size_t robot, Nanoseconds now) {
    std::optional<Pose> pose = model.poseAt(robot, now);
    const std::optional<Pose> next = model.poseAt(robot, now + model.step);
    if (!pose || !next) return pose;
    const double share = static_cast<double>(now % model.step) / static_cast<double>(model.step);
    const Pose by{next->x - pose->x, next->y - pose->y, wrapAngle(next->heading - pose->heading)};
    return Pose{pose->x + share * by.x, pose->y + share * by.y, pose->heading + share * by.heading};
}

enum class Heading { none, line, arrow };

void drawOutline(const FieldCanvas& canvas, const Shape& shape, const Pose& pose, const QColor& colour, double width,
                 Heading heading) {
    const QPainterPath outline = silhouette(canvas, shape, pose);
    for (const QPen& pen : {roundPen(withAlpha(setOff(colour), 190), width + 2.2), roundPen(colour, width)}) {
        canvas.painter.setBrush(Qt::NoBrush);
        canvas.painter.setPen(pen);
        canvas.painter.drawPath(outline);
        if (heading != Heading::none) drawNose(canvas, shape, pose, pen, heading == Heading::arrow);
    }
}

/// Where it was seen last.
void drawLost(const FieldCanvas& canvas, const RealRobot& robot) {
    const QColor colour = withAlpha(realColour(robot.place, canvas.theme), 170);
    QPen pen = roundPen(colour, 1.4, Qt::CustomDashLine);
    pen.setDashPattern({3, 3});
    canvas.painter.setBrush(Qt::NoBrush);
    canvas.painter.setPen(pen);
    canvas.painter.drawPath(silhouette(canvas, *robot.shape, robot.pose));
    QFont font = plateFont(canvas.painter);
    font.setBold(true);
    canvas.painter.setFont(font);
    canvas.painter.setPen(canvas.theme.onFloor);
    const QPointF at = canvas.at(position(robot.pose));
    canvas.painter.drawText(QRectF(at - QPointF(12, 12), QSizeF(24, 24)), Qt::AlignCenter, "?");
}

void drawError(const FieldCanvas& canvas, const FieldFrame& frame, const RealRobot& robot) {
    if (!robot.apart || robot.apart->position < leastError) return;
    const QPointF from = canvas.at(position(frame.poseOf(*robot.body))), to = canvas.at(position(robot.pose));
    if (std::hypot((to - from).x(), (to - from).y()) < leastErrorPixels) return;
    canvas.casedLine(from, to, roundPen(canvas.theme.onFloor, 1.4));
    canvas.painter.setPen(roundPen(withAlpha(setOff(canvas.theme.onFloor), 150), 1));
    canvas.painter.setBrush(canvas.theme.onFloor);
    canvas.painter.drawEllipse(to, 2.6, 2.6);
}

/// A body and its simulated one that overlap are named as one.
void standBesideBoth(const FieldCanvas& canvas, const Pose& simulated, FieldLabel& label) {
    const QPointF real = canvas.at(label.at), other = canvas.at(position(simulated));
    const double apart = std::hypot((other - real).x(), (other - real).y());
    if (apart > 2 * label.clearance) return;
    label.at = {(label.at.x + simulated.x) / 2, (label.at.y + simulated.y) / 2};
    label.clearance += apart / 2 + focusRing;
}

}  // namespace

void drawRealWays(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus) {
    const QColor floor = floorColour(frame.scene().environment, canvas.theme);
    const Nanoseconds now = frame.now();
    canvas.painter.setBrush(Qt::NoBrush);
    for (const RealRobot& robot : realRobots(frame)) {
        const Reality::Robot& of = frame.reality->robots[robot.index];
        const QColor colour = realColour(robot.place, canvas.theme);
        const bool others = focus.selected && *focus.selected < frame.scene().robots.size() &&
                            focus.selected != robot.body;  // keep behind it
        drawHollow(canvas, wayBetween(canvas, of, now, now + ahead), mixed(colour, floor, others ? 0.75 : 0.6), floor);
        drawHollow(canvas, wayBetween(canvas, of, now - trailSpan(frame), now), mixed(colour, floor, others ? 0.3 : 0),
                   floor);
    }
}

void drawModelWays(const FieldCanvas& canvas, const FieldFrame& frame) {
    if (!frame.reality) return;
    const Nanoseconds now = frame.now(), span = trailSpan(frame);
    canvas.painter.setBrush(Qt::NoBrush);
    for (std::size_t m = 0; m < frame.reality->models.size(); ++m) {
        const Reality::ModelRollout& model = frame.reality->models[m];
        for (const std::vector<Pose>& poses : model.poses) {
            WayLine way;
            const auto to = std::min(static_cast<std::size_t>(now / model.step + 1), poses.size());
            for (auto i = static_cast<std::size_t>((now - span) / model.step); i < to; ++i)
                way.add(canvas.at(position(poses[i])));
            for (const QPolygonF& line : way.lines()) canvas.casedLine(line, modelPen(m, 1.4));
        }
    }
}

void drawModelRobots(const FieldCanvas& canvas, const FieldFrame& frame, bool headings) {
    if (!frame.reality) return;
    for (std::size_t m = 0; m < frame.reality->models.size(); ++m)
        for (std::size_t i = 0; i < frame.reality->robots.size(); ++i) {
            const auto body = bodyOf(frame, frame.reality->robots[i]);
            const auto pose = modelPose(frame.reality->models[m], i, frame.now());
            if (!body || !pose) continue;
            const Shape& shape = frame.scene().shapeOf(*body);
            if (canvas.visible(position(*pose), shape.reach))
                drawOutline(canvas, shape, *pose, modelColour(m), 1.3, headings ? Heading::line : Heading::none);
        }
}

void drawRealRobots(const FieldCanvas& canvas, const FieldFrame& frame, bool headings) {
    const std::vector<RealRobot> robots = realRobots(frame);
    for (const RealRobot& robot : robots) {
        if (!canvas.visible(position(robot.pose), robot.shape->reach)) continue;
        if (robot.known())
            drawOutline(canvas, *robot.shape, robot.pose, realColour(robot.place, canvas.theme), 2,
                        headings ? Heading::arrow : Heading::none);
        else
            drawLost(canvas, robot);
    }
    for (const RealRobot& robot : robots) drawError(canvas, frame, robot);
}

void addRealNames(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
                  std::vector<FieldLabel>& labels) {
    for (const RealRobot& robot : realRobots(frame)) {
        const double reach = canvas.pixels(robot.shape->reach);
        const bool looked = robot.body && (focus.selected == robot.body || focus.hovered == robot.body);
        const bool beside = looked && robot.apart && robot.apart->position >= leastError;
        if ((robot.body && !beside) || !canvas.visible(position(robot.pose), robot.shape->reach)) continue;
        FieldLabel& label = labels.emplace_back();
        label.key = std::uint64_t{5} << 56 | robot.index;
        label.at = position(robot.pose);
        label.clearance = reach + 2;
        if (beside) standBesideBoth(canvas, frame.poseOf(*robot.body), label);
        const char* const real = realWord(frame);
        label.text = beside ? QObject::tr("%1: %2").arg(real, errorText(*robot.apart))
                            : QObject::tr("%1 %2").arg(real, qtText(frame.reality->robots[robot.index].name));
        label.colour = canvas.theme.onFloor;
        label.chip = realColour(robot.place, canvas.theme);
        label.first = looked;
    }
}

}  // namespace mrose
