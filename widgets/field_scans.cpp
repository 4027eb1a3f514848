// What sensors that measure their robot's surroundings gave last: from where they were then.
#include <QObject>
#include <QStringList>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "control/sensor_records.h"
#include "widgets/field_drawing.h"
#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"

namespace mrose {
namespace {

using Kind = SensorScan::Kind;

constexpr double radianInDegrees = 180 / std::numbers::pi;
constexpr double bumperGap = 3.5, bumperSpace = 0.06;  // pixels off the outline; rad between segments
constexpr double scanReach = 5;                        // pixels: so near is at it

FieldLayer layerOf(Kind kind) {
    switch (kind) {
        case Kind::laser:
            return FieldLayer::laser;
        case Kind::sonar:
            return FieldLayer::sonar;
        case Kind::infrared:
            return FieldLayer::infrared;
        case Kind::bumpers:
            return FieldLayer::bumpers;
        case Kind::lineCamera:
            return FieldLayer::lineCameras;
    }
    return FieldLayer::laser;
}

Pose inWorld(const SensorScan& scan, const SensorElement& element) {
    const Point place = Placement(scan.eye).place(position(element.mount));
    return {place.x, place.y, scan.eye.heading + element.mount.heading};
}

Point pointAlong(const Pose& pose, double range, double turn = 0) {
    return position(pose) + range * towards(pose.heading + turn);
}

/// Draws with those that the eye is on last, above the others.
template <class Draw>
void drawEachScan(const FieldFocus& focus, const std::vector<RobotScans>& scans, Kind kind, Draw draw) {
    for (const bool strong : {false, true})
        for (const RobotScans& of : scans) {
            if ((scans.size() == 1 || focus.selected == of.robot) != strong || focus.isQuiet(of.robot)) continue;
            for (const SensorScan& scan : of.scans)
                if (scan.kind == kind) draw(of.robot, scan, strong);
        }
}

/// What the beams passed freely; one without an echo reaches as far as it can.
void drawFan(const FieldCanvas& canvas, const SensorScan& scan, const QColor& colour) {
    const auto echoes = scan.known.records<RangeEcho>();
    QPolygonF fan;
    for (std::size_t i = 0; i < echoes.size(); ++i) {
        const Pose beam = inWorld(scan, scan.elements[i]);
        if (i == 0) fan.append(canvas.at(position(beam)));
        fan.append(canvas.at(pointAlong(beam, std::min(echoes[i].range, scan.elements[i].range))));
    }
    canvas.painter.setPen(Qt::NoPen);
    canvas.painter.setBrush(colour);
    canvas.painter.drawPolygon(fan);
}

void drawDots(const FieldCanvas& canvas, const SensorScan& scan, const QColor& colour, double size) {
    const auto echoes = scan.known.records<RangeEcho>();
    QVector<QRectF> dots;
    for (std::size_t i = 0; i < echoes.size(); ++i)
        if (std::isfinite(echoes[i].range)) {
            const QPointF at = canvas.at(pointAlong(inWorld(scan, scan.elements[i]), echoes[i].range));
            dots.append(QRectF(at - QPointF(size / 2, size / 2), QSizeF(size, size)));
        }
    canvas.painter.setPen(Qt::NoPen);
    canvas.painter.setBrush(colour);
    canvas.painter.drawRects(dots);
}

/// A sector of a circle in pixels, for Qt's pies and arcs.
struct Sector {
    QRectF circle;
    int first = 0, span = 0;  ///< 1/16 degree, counter-clockwise from the right

    Sector(const FieldCanvas& canvas, const Pose& pose, double halfWidth, double range) {
        const double radius = canvas.pixels(range);
        const QPointF at = canvas.at(position(pose)), along = canvas.view.along(pose.heading);
        circle = QRectF(at - QPointF(radius, radius), 2 * QSizeF(radius, radius));
        const double direction = std::atan2(-along.y(), along.x());
        first = static_cast<int>(std::lround((direction - halfWidth) * radianInDegrees * 16));
        span = static_cast<int>(std::lround(2 * halfWidth * radianInDegrees * 16));
    }
};

void drawCones(const FieldCanvas& canvas, const SensorScan& scan, const QColor& colour) {
    const auto echoes = scan.known.records<RangeEcho>();
    for (std::size_t i = 0; i < echoes.size(); ++i) {
        if (!std::isfinite(echoes[i].range)) continue;
        const SensorElement& element = scan.elements[i];
        const Sector sector(canvas, inWorld(scan, element), element.halfWidth, echoes[i].range);
        drawEcho(canvas.painter, sector.circle, sector.first, sector.span, colour);
    }
}

/// m, where a surface that faces an infrared element would send back so much of its light.
double glowReach(const SensorElement& element, double intensity) {
    return intensity > 0 ? std::min(element.range, element.reference / std::sqrt(intensity)) : element.range;
}

void drawGlow(const FieldCanvas& canvas, const SensorScan& scan, const QColor& colour) {
    const auto echoes = scan.known.records<InfraredEcho>();
    canvas.painter.setPen(Qt::NoPen);
    for (std::size_t i = 0; i < echoes.size(); ++i) {
        const SensorElement& element = scan.elements[i];
        const double reach = glowReach(element, echoes[i].intensity);
        const Sector sector(canvas, inWorld(scan, element), element.halfWidth, reach);
        // Light falls off with the square of the distance.
        const double strength = std::sqrt(std::min(1.0, echoes[i].intensity));
        canvas.painter.setBrush(withAlpha(colour, 18 + static_cast<int>(200 * strength)));
        canvas.painter.drawPie(sector.circle, sector.first, sector.span);
    }
}

/// m, how far the outline of a shape is from its reference point in a direction.
double rimOf(const Shape& shape, const Point& along) {
    double farthest = 0;
    for (const ConvexPiece& piece : shape.pieces) {
        if (piece.isCircle()) {
            const Point to = piece.centre;
            const double forward = to.x * along.x + to.y * along.y, aside = to.x * along.y - to.y * along.x;
            if (std::abs(aside) < piece.radius)
                farthest = std::max(farthest, forward + std::sqrt(piece.radius * piece.radius - aside * aside));
            continue;
        }
        for (std::size_t i = 0; i < piece.count; ++i) {
            const Point a = piece.corners[i], edge = piece.corners[piece.cornerAfter(i)] - a;
            const double across = along.x * edge.y - along.y * edge.x;
            if (across == 0) continue;
            const double share = (a.x * along.y - a.y * along.x) / across;
            if (share >= 0 && share <= 1) farthest = std::max(farthest, (a.x * edge.y - a.y * edge.x) / across);
        }
    }
    return farthest;
}

void drawSegments(const FieldCanvas& canvas, const SensorScan& scan, const Shape& shape, const Pose& pose) {
    constexpr double leastReach = 7;  // pixels
    if (canvas.pixels(shape.reach) < leastReach) return;
    const auto contacts = scan.known.records<BumperContact>();
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const SensorElement& element = scan.elements[i];
        const double half = std::max(0.2 * element.halfWidth, element.halfWidth - bumperSpace);
        const int steps = std::max(2, static_cast<int>(std::ceil(2 * half / 0.1)));
        QPolygonF line;
        for (int k = 0; k <= steps; ++k) {
            const double turn = element.mount.heading + half * (2.0 * k / steps - 1);
            const QPointF outward = canvas.view.along(pose.heading + turn);
            line.append(canvas.at(pointAlong(pose, rimOf(shape, towards(turn)), turn)) + bumperGap * outward);
        }
        drawBumperSegment(canvas, line, contacts[i].pressed != 0);
    }
}

/// Of the colours that a league's rules or a field give what is there.
QColor colourOf(ColourClass colourClass) {
    switch (colourClass) {
        case ColourClass::nothing:
            return {90, 90, 96};
        case ColourClass::floor:
            return {38, 140, 74};
        case ColourClass::marking:
            return {255, 255, 255};
        case ColourClass::wall:
            return {214, 214, 220};
        case ColourClass::obstacle:
            return {150, 120, 95};
        case ColourClass::yellowGoal:
            return {250, 205, 0};
        case ColourClass::blueGoal:
            return {40, 90, 215};
        case ColourClass::ball:
            return {255, 110, 0};
        case ColourClass::box:
            return {176, 132, 84};
        case ColourClass::person:
            return {232, 178, 150};
        case ColourClass::robot:
            return {20, 20, 24};
        case ColourClass::teamMate:
            return {60, 205, 230};
        case ColourClass::opponent:
            return {225, 40, 130};
    }
    return {};
}

constexpr double stripGap = 11, stripWidth = 6;  // pixels

/// Visits the runs of pixels of one class, each by its first one and how many they are.
template <class Visit>
void visitRuns(std::span<const ColourPixel> row, Visit visit) {
    for (std::size_t first = 0, next = 0; first < row.size(); first = next) {
        while (next < row.size() && row[next].colourClass == row[first].colourClass) ++next;
        visit(first, next - first);
    }
}

double halfPixel(std::span<const ColourPixel> row, std::size_t i) {
    const std::size_t other = i + 1 < row.size() ? i + 1 : i - 1;
    return row.size() < 2 ? 0.01
                          : std::abs(std::remainder(row[other].bearing - row[i].bearing, 2 * std::numbers::pi)) / 2;
}

/// On a circle about the camera, outside of its robot.
void drawRow(const FieldCanvas& canvas, const SensorScan& scan, const Shape& shape) {
    const auto row = scan.known.records<ColourPixel>();
    const Pose camera = inWorld(scan, {scan.elements.front().mount, 0, 0});
    const double radius = canvas.pixels(shape.reach) + stripGap;
    visitRuns(row, [&](std::size_t first, std::size_t count) {
        const double from = row[first].bearing - halfPixel(row, first);
        double width = 0;  // up to a whole turn
        for (std::size_t i = first; i < first + count; ++i) width += 2 * halfPixel(row, i);
        const int steps = std::max(1, static_cast<int>(std::ceil(width / 0.05)));
        QPolygonF line;
        for (int k = 0; k <= steps; ++k)
            line.append(canvas.at(position(camera)) +
                        radius * canvas.view.along(scan.eye.heading + from + width * k / steps));
        drawPixelStrip(canvas, line, row[first].colourClass);
    });
}

/// Of the run of pixels whose part of the strip is there.
QString rowReadout(const ViewTransform& view, const SensorScan& scan, const Shape& shape, const QPointF& pixels) {
    const auto row = scan.known.records<ColourPixel>();
    const Pose camera = inWorld(scan, {scan.elements.front().mount, 0, 0});
    const QPointF off = pixels - view.toPixels(position(camera));
    if (std::abs(std::hypot(off.x(), off.y()) - shape.reach * view.scale() - stripGap) > stripWidth / 2 + 1) return {};
    const double bearing = direction(view.toMetres(pixels) - position(camera)) - scan.eye.heading;
    const auto away = [&](std::size_t i) {
        return std::abs(std::remainder(bearing - row[i].bearing, 2 * std::numbers::pi));
    };
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < row.size(); ++i)
        if (away(i) < away(nearest)) nearest = i;
    QString said;
    visitRuns(row, [&](std::size_t first, std::size_t count) {
        if (nearest < first || nearest >= first + count || away(nearest) > 1.1 * halfPixel(row, nearest)) return;
        said = QObject::tr("%1, %2 pixels, at %3\u00b0")
                   .arg(qtText(std::string(wordOf(row[nearest].colourClass))))
                   .arg(count)
                   .arg(fixedText(row[nearest].bearing * radianInDegrees, 1));
    });
    return said;
}

QString rangeText(const RangeEcho& echo) {
    return QObject::tr("%1 m at %2\u00b0").arg(fixedText(echo.range, 2), fixedText(echo.bearing * radianInDegrees, 1));
}

/// Of an echo that is drawn near to a place; empty: there is none.
QString echoReadout(const ViewTransform& view, const SensorScan& scan, const QPointF& pixels) {
    const auto echoes = scan.known.records<RangeEcho>();
    const RangeEcho* nearest = nullptr;
    double least = scanReach;
    for (std::size_t i = 0; i < echoes.size(); ++i) {
        if (!std::isfinite(echoes[i].range)) continue;
        const Pose element = inWorld(scan, scan.elements[i]);
        const Point to = view.toMetres(pixels) - position(element);
        const double half = scan.elements[i].halfWidth;
        const double turn = std::remainder(direction(to) - element.heading, 2 * std::numbers::pi);
        const Point at = pointAlong(element, echoes[i].range, std::clamp(turn, -half, half));
        const QPointF off = view.toPixels(at) - pixels;
        const double away = std::hypot(off.x(), off.y());
        if (away < least) least = away, nearest = &echoes[i];
    }
    return nearest == nullptr ? QString() : rangeText(*nearest);
}

/// Of the element into whose beam a place lies.
QString glowReadout(const ViewTransform& view, const SensorScan& scan, const QPointF& pixels) {
    const auto echoes = scan.known.records<InfraredEcho>();
    for (std::size_t i = 0; i < echoes.size(); ++i) {
        const Pose element = inWorld(scan, scan.elements[i]);
        const Point to = view.toMetres(pixels) - position(element);
        const double turn = std::remainder(direction(to) - element.heading, 2 * std::numbers::pi);
        if (length(to) > glowReach(scan.elements[i], echoes[i].intensity) ||
            std::abs(turn) > scan.elements[i].halfWidth)
            continue;
        return QObject::tr("intensity %1 at %2\u00b0")
            .arg(fixedText(echoes[i].intensity, 2), fixedText(echoes[i].bearing * radianInDegrees, 1));
    }
    return {};
}

/// Of the segment that is drawn near to a place.
QString segmentReadout(const ViewTransform& view, const SensorScan& scan, const Shape& shape, const Pose& pose,
                       const QPointF& pixels) {
    const Point to = view.toMetres(pixels) - position(pose);
    const double turn = direction(to) - pose.heading, rim = rimOf(shape, towards(turn));
    if (std::abs((length(to) - rim) * view.scale() - bumperGap) > scanReach) return {};
    const auto contacts = scan.known.records<BumperContact>();
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const SensorElement& element = scan.elements[i];
        if (std::abs(std::remainder(turn - element.mount.heading, 2 * std::numbers::pi)) > element.halfWidth) continue;
        const QString at = fixedText(contacts[i].bearing * radianInDegrees, 1);
        return contacts[i].pressed == 0 ? QObject::tr("free at %1\u00b0").arg(at)
                                        : QObject::tr("pressed at %1\u00b0").arg(at);
    }
    return {};
}

QString readoutOf(const ViewTransform& view, const SensorScan& scan, const Shape& shape, const Pose& pose,
                  const QPointF& pixels) {
    switch (scan.kind) {
        case Kind::laser:
        case Kind::sonar:
            return echoReadout(view, scan, pixels);
        case Kind::infrared:
            return glowReadout(view, scan, pixels);
        case Kind::bumpers:
            return segmentReadout(view, scan, shape, pose, pixels);
        case Kind::lineCamera:
            return rowReadout(view, scan, shape, pixels);
    }
    return {};
}

}  // namespace

void drawPixelStrip(const FieldCanvas& canvas, const QPolygonF& line, ColourClass colourClass) {
    for (const QPen& pen : {QPen(QColor(0, 0, 0, 150), stripWidth + 2, Qt::SolidLine, Qt::FlatCap),
                            QPen(colourOf(colourClass), stripWidth, Qt::SolidLine, Qt::FlatCap)}) {
        canvas.painter.setPen(pen);
        canvas.painter.drawPolyline(line);
    }
}

std::vector<RobotScans> shownScans(const FieldFrame& frame, const FieldLayers& layers, const FieldFocus& focus) {
    std::vector<RobotScans> shown;
    constexpr std::array scanLayers{FieldLayer::laser, FieldLayer::sonar, FieldLayer::infrared, FieldLayer::bumpers,
                                    FieldLayer::lineCameras};
    if (std::ranges::none_of(scanLayers, [&](FieldLayer layer) { return layers.has(layer); })) return shown;
    const std::size_t robots = frame.state.robots.size();
    for (std::size_t robot = 0; robot < robots; ++robot) {
        if (frame.scene().typeOf(robot).sensors.empty()) continue;
        if (robots > mostNames && focus.selected != robot) continue;
        RobotScans of{robot, scansOf(frame, robot)};
        std::erase_if(of.scans, [&](const SensorScan& scan) { return !layers.has(layerOf(scan.kind)); });
        if (!of.scans.empty()) shown.push_back(std::move(of));
    }
    return shown;
}

bool hasScan(const std::vector<RobotScans>& scans, FieldLayer layer) {
    return std::ranges::any_of(scans, [&](const RobotScans& of) {
        return std::ranges::any_of(of.scans, [&](const SensorScan& scan) { return layerOf(scan.kind) == layer; });
    });
}

void drawEcho(QPainter& painter, const QRectF& circle, int first, int span, const QColor& colour) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(withAlpha(colour, colour.alpha() / 8));
    painter.drawPie(circle, first, span);
    painter.setPen(QPen(colour, 1.8, Qt::SolidLine, Qt::FlatCap));
    painter.drawArc(circle, first, span);
}

void drawBumperSegment(const FieldCanvas& canvas, const QPolygonF& line, bool pressed) {
    if (pressed) return canvas.casedLine(line, roundPen(canvas.theme.contact, 4));
    canvas.painter.setPen(QPen(withAlpha(canvas.theme.onFloor, 190), 2, Qt::SolidLine, Qt::FlatCap));
    canvas.painter.drawPolyline(line);
}

void drawScanAreas(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
                   const std::vector<RobotScans>& scans) {
    const auto colourOf = [&](std::size_t robot) { return robotColour(frame.scene(), robot); };
    canvas.painter.setRenderHint(QPainter::Antialiasing, false);
    drawEachScan(focus, scans, Kind::laser, [&](std::size_t robot, const SensorScan& scan, bool strong) {
        drawFan(canvas, scan, withAlpha(colourOf(robot), strong ? 64 : 34));
    });
    canvas.painter.setRenderHint(QPainter::Antialiasing);
    drawEachScan(focus, scans, Kind::infrared,
                 [&](std::size_t robot, const SensorScan& scan, bool) { drawGlow(canvas, scan, colourOf(robot)); });
    drawEachScan(focus, scans, Kind::sonar, [&](std::size_t robot, const SensorScan& scan, bool strong) {
        drawCones(canvas, scan, withAlpha(colourOf(robot), strong ? 255 : 170));
    });
}

void drawScanMarks(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
                   const std::vector<RobotScans>& scans) {
    canvas.painter.setRenderHint(QPainter::Antialiasing, false);
    drawEachScan(focus, scans, Kind::laser, [&](std::size_t robot, const SensorScan& scan, bool strong) {
        if (strong) drawDots(canvas, scan, withAlpha(setOff(robotColour(frame.scene(), robot)), 70), 5);
        drawDots(canvas, scan, robotColour(frame.scene(), robot), 3);
    });
    canvas.painter.setRenderHint(QPainter::Antialiasing);
    drawEachScan(focus, scans, Kind::bumpers, [&](std::size_t robot, const SensorScan& scan, bool) {
        drawSegments(canvas, scan, frame.scene().shapeOf(robot), frame.poseOf(robot));
    });
    drawEachScan(focus, scans, Kind::lineCamera, [&](std::size_t robot, const SensorScan& scan, bool) {
        drawRow(canvas, scan, frame.scene().shapeOf(robot));
    });
}

QString scanReadout(const ViewTransform& view, const FieldFrame& frame, const std::vector<RobotScans>& scans,
                    const QPointF& pixels) {
    QStringList lines;
    for (const RobotScans& of : scans)
        for (const SensorScan& scan : of.scans) {
            const QString said = readoutOf(view, scan, frame.scene().shapeOf(of.robot), frame.poseOf(of.robot), pixels);
            if (said.isEmpty()) continue;
            lines += QObject::tr("%1 of %2: %3, %4 s ago")
                         .arg(qtText(scan.known.sensor->name()), qtText(frame.nameOf(of.robot)), said,
                              fixedText(toSeconds(frame.now() - scan.known.reading->measured), 2));
        }
    return lines.join('\n');
}

}  // namespace mrose
