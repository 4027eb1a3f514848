#include <algorithm>
#include <cmath>
#include <optional>

#include "widgets/field_drawing.h"

namespace mrose {
namespace {

QColor wayColour(const FieldFrame& frame, std::size_t body) {
    return body < frame.state.robots.size() ? robotColour(frame.scene(), body) : QColor(255, 255, 255);
}

/// Long ago is faint: the share of a trail's lines from which on each is drawn stronger.
constexpr int fadingSteps = 4;

/// Faster is nothing that moves here: who is farther off after a tick was put there.
constexpr double fastest = 30;  // m/s

QVector<QPolygonF> wayOf(const FieldCanvas& canvas, const Trails& trails, std::size_t body, Nanoseconds tickLength) {
    const double farthest = fastest * toSeconds(tickLength);
    WayLine way;
    std::optional<Point> before;
    trails.visit(body, [&](const Point& point, bool begins) {
        if (begins || (before && distance(*before, point) > farthest)) way.begin();
        way.add(canvas.at(point));
        before = point;
    });
    return way.lines();
}

/// Colours that are this near to the floor's are set off from it.
constexpr double leastContrast = 1.45;

void drawFading(const FieldCanvas& canvas, const QVector<QPolygonF>& lines, const QColor& colour, double width,
                bool cased) {
    int points = 0, drawn = 0;
    for (const QPolygonF& line : lines) points += line.size();
    for (const QPolygonF& line : lines) {
        const int share = std::max(2, points / fadingSteps);
        for (int from = 0; from + 1 < line.size(); from += share) {
            const int size = std::min(share + 1, line.size() - from);
            const int alpha = 110 + 130 * (drawn + from + size) / std::max(1, points);
            QPen pen = roundPen(withAlpha(colour, std::min(alpha, 240)), width);
            pen.setCapStyle(Qt::FlatCap);
            pen.setJoinStyle(Qt::BevelJoin);  // the points lie close: a round one costs far more and looks the same
            const QPolygonF part(line.mid(from, size));
            canvas.painter.setPen(pen);
            cased ? canvas.casedLine(part, pen) : canvas.painter.drawPolyline(part);
        }
        drawn += line.size();
    }
}

}  // namespace

void drawTrails(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus) {
    const bool few = frame.trails.bodies() <= mostNames;
    const QColor floor = floorColour(frame.scene().environment, canvas.theme);
    canvas.painter.setBrush(Qt::NoBrush);
    for (std::size_t body = 0; body < frame.trails.bodies(); ++body) {
        const QVector<QPolygonF> lines = wayOf(canvas, frame.trails, body, frame.scene().tickLength);
        const QColor colour = wayColour(frame, body);
        if (few || focus.selected == body) {
            drawFading(canvas, lines, colour, focus.selected == body ? 2.4 : 1.6,
                       contrast(colour, floor) < leastContrast);
            continue;
        }
        canvas.painter.setRenderHint(QPainter::Antialiasing, false);
        canvas.painter.setPen(hairline(withAlpha(colour, 200)));
        for (const QPolygonF& line : lines) canvas.painter.drawPolyline(line);
        canvas.painter.setRenderHint(QPainter::Antialiasing);
    }
}

void drawGhosts(const FieldCanvas& canvas, const FieldFrame& frame) {
    const bool few = frame.scene().bodyCount() <= mostNames;
    canvas.painter.setRenderHint(QPainter::Antialiasing, few);
    for (const Ghost& ghost : frame.ghosts) {
        for (std::size_t body = 0; body < ghost.trails.bodies(); ++body) {
            canvas.painter.setPen(few ? roundPen(withAlpha(wayColour(frame, body), 170), 1.4, Qt::DotLine)
                                      : hairline(withAlpha(wayColour(frame, body), 130)));
            for (const QPolygonF& line : wayOf(canvas, ghost.trails, body, frame.scene().tickLength))
                canvas.painter.drawPolyline(line);
        }
        for (std::size_t body = 0; body < ghost.bodies.size(); ++body) {
            const Shape& shape = ghost.scenario->scene().shapeOf(body);
            if (!canvas.visible(position(ghost.bodies[body]), shape.reach)) continue;
            const QColor colour = wayColour(frame, body);
            canvas.painter.setBrush(withAlpha(colour, 46));
            canvas.painter.setPen(roundPen(withAlpha(colour, 190), 1.2, Qt::DashLine));
            canvas.parts(shape, ghost.bodies[body]);
        }
    }
    canvas.painter.setRenderHint(QPainter::Antialiasing);
}

void drawPredicted(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus) {
    const std::size_t everySecond =
        frame.predictedStep > 0 ? static_cast<std::size_t>(nanosecondsPerSecond / frame.predictedStep) : 0;
    for (std::size_t robot = 0; robot < frame.predicted.size(); ++robot) {
        const std::vector<Pose>& poses = frame.predicted[robot];
        if (poses.size() < 2) continue;
        WayLine way;
        for (const Pose& pose : poses) way.add(canvas.at(position(pose)));
        const bool selected = focus.selected == robot;
        const QColor colour = selected ? canvas.theme.accent : QColor(255, 255, 255, focus.selected ? 150 : 220);
        QPen pen = roundPen(colour, selected ? 2 : 1.5, Qt::CustomDashLine);
        pen.setDashPattern({4, 2.5});
        canvas.painter.setBrush(Qt::NoBrush);
        for (const QPolygonF& line : way.lines()) canvas.casedLine(line, pen);
        if (length(position(poses.back()) - position(poses.front())) * canvas.view.scale() < 6) continue;
        // A bead at each second, and where it ends.
        canvas.painter.setPen(roundPen(withAlpha(setOff(colour), 150), 1));
        canvas.painter.setBrush(colour);
        for (std::size_t i = everySecond; everySecond > 0 && i < poses.size(); i += everySecond)
            canvas.painter.drawEllipse(canvas.at(position(poses[i])), 2.6, 2.6);
    }
}

}  // namespace mrose
