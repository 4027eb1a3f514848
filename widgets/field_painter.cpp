#include "widgets/field_painter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <QFontMetricsF>
#include <QPainterPath>

namespace mrose {
namespace {

/// Bodies smaller than this (pixels) are dots; of more bodies than that, nothing is smoothed.
constexpr double leastDetail = 5;
constexpr std::size_t mostSmooth = 200;
/// Names of more visible bodies than these would hide the picture.
constexpr std::size_t mostNames = 80;

/// A line of one device pixel, whatever the scale: wider ones go through a slow stroker.
QPen hairline(const QColor& colour, Qt::PenStyle style = Qt::SolidLine) {
    QPen pen(colour, 1, style);
    pen.setCosmetic(true);
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

/// 1, 2 or 5 times a power of ten, at least `least`.
double roundStep(double least) {
    const double power = std::pow(10, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= least * (1 - 1e-9)) return factor * power;
    return 10 * power;
}

}  // namespace

QString lengthText(double metres) {
    if (std::abs(metres) < 0.9995) return QString::number(100 * metres, 'f', std::abs(metres) < 0.0995 ? 1 : 0) + " cm";
    return QString::number(metres, 'f', std::abs(metres) < 9.995 ? 2 : 1) + " m";
}

FieldArea areaOf(const Environment& environment) {
    FieldArea area{{1, 1}, {-1, -1}};
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

FieldArea areaOf(const FieldFrame& frame) {
    FieldArea area = areaOf(frame.scene().environment);
    for (std::size_t body = 0; body < frame.scene().bodyCount(); ++body)
        area.include(position(frame.poseOf(body)), frame.scene().shapeOf(body).reach);
    return area;
}

FieldPainter::FieldPainter(QPainter& painter, const ViewTransform& view, const Theme& theme, const FieldLayers& layers)
    : painter_(painter), view_(view), theme_(theme), layers_(layers), shown_(view.shown()) {}

bool FieldPainter::visible(const Point& at, double reach) const {
    return at.x + reach >= shown_.least.x && at.x - reach <= shown_.most.x && at.y + reach >= shown_.least.y &&
           at.y - reach <= shown_.most.y;
}

QPolygonF FieldPainter::mapped(const Polygon& polygon, const Placement& at) const {
    QPolygonF pixels;
    pixels.reserve(static_cast<int>(polygon.size()));
    for (const Point& corner : polygon) pixels.append(view_.toPixels(at.place(corner)));
    return pixels;
}

void FieldPainter::place(const Environment& environment) {
    painter_.fillRect(QRectF(QPointF(0, 0), view_.size()), theme_.surround);
    painter_.setRenderHint(QPainter::Antialiasing);
    const Placement here;
    painter_.setPen(Qt::NoPen);
    // A dark room does not want a bright floor.
    const QColor floor = toQColor(environment.floor.colour);
    painter_.setBrush(theme_.dark ? floor.darker(170) : floor);
    painter_.drawPolygon(mapped(environment.floor.area, here));
    for (const Goal& goal : environment.goals) {
        painter_.setBrush(QColor(255, 255, 255, 40));
        painter_.drawPolygon(mapped(goal.area, here));
    }
    if (layers_.has(FieldLayer::grid)) grid();
    painter_.setBrush(Qt::NoBrush);
    for (const Marking& marking : environment.markings) {
        QPen pen(toQColor(marking.colour), std::max(1.0, marking.width * view_.scale()));
        pen.setCapStyle(Qt::FlatCap);
        pen.setJoinStyle(Qt::MiterJoin);
        painter_.setPen(pen);
        if (marking.radius > 0)
            painter_.drawEllipse(view_.toPixels(marking.centre), marking.radius * view_.scale(),
                                 marking.radius * view_.scale());
        else if (marking.closed)
            painter_.drawPolygon(mapped(marking.points, here));
        else
            painter_.drawPolyline(mapped(marking.points, here));
    }
    for (const Obstacle& obstacle : environment.obstacles) shape(obstacle.shape, {}, true);
}

void FieldPainter::grid() {
    const double step = roundStep(48 / view_.scale());
    painter_.setRenderHint(QPainter::Antialiasing, false);
    QFont font = painter_.font();
    font.setPointSizeF(8);
    painter_.setFont(font);
    const QColor line = withAlpha(theme_.dark ? QColor(255, 255, 255) : QColor(0, 0, 0), 38);
    const auto text = [&](double value) {
        return QString::number(value, 'f', std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9))));
    };
    for (double x = std::ceil(shown_.least.x / step) * step; x <= shown_.most.x; x += step) {
        const double at = view_.toPixels({x, 0}).x();
        painter_.setPen(hairline(line));
        painter_.drawLine(QPointF(at, 0), QPointF(at, view_.size().height()));
        painter_.setPen(theme_.quietText);
        painter_.drawText(QPointF(at + 3, 11), text(std::abs(x) < step / 2 ? 0 : x));
    }
    for (double y = std::ceil(shown_.least.y / step) * step; y <= shown_.most.y; y += step) {
        const double at = view_.toPixels({0, y}).y();
        painter_.setPen(hairline(line));
        painter_.drawLine(QPointF(0, at), QPointF(view_.size().width(), at));
        painter_.setPen(theme_.quietText);
        painter_.drawText(QPointF(3, at - 3), text(std::abs(y) < step / 2 ? 0 : y));
    }
    painter_.setRenderHint(QPainter::Antialiasing);
}

void FieldPainter::frame(const FieldFrame& frame, const FieldFocus& focus) {
    painter_.setRenderHint(QPainter::Antialiasing);
    if (layers_.has(FieldLayer::sensors)) sensors(frame, focus);
    if (layers_.has(FieldLayer::trails)) trails(frame);
    if (layers_.has(FieldLayer::ghosts)) ghosts(frame);
    if (layers_.has(FieldLayer::predicted)) predicted(frame, focus);
    bodies(frame, focus);
    if (layers_.has(FieldLayer::beliefs)) beliefs(frame, focus);
    if (layers_.has(FieldLayer::targets)) notes(frame, focus);
    if (layers_.has(FieldLayer::contacts)) contacts(frame);
    kicks(frame);
    if (layers_.has(FieldLayer::names)) names(frame, focus);
}

void FieldPainter::polyline(const std::vector<Point>& points, const QPen& pen) {
    if (points.size() < 2) return;
    QPolygonF pixels;
    pixels.reserve(static_cast<int>(points.size()));
    // What moves by less than a pixel adds nothing but time.
    QPointF last(1e9, 1e9);
    for (const Point& point : points) {
        const QPointF pixel = view_.toPixels(point);
        if (std::abs(pixel.x() - last.x()) + std::abs(pixel.y() - last.y()) < 1 && &point != &points.back()) continue;
        pixels.append(pixel);
        last = pixel;
    }
    painter_.setPen(pen);
    painter_.setBrush(Qt::NoBrush);
    painter_.drawPolyline(pixels);
}

void FieldPainter::trails(const FieldFrame& frame) {
    painter_.setRenderHint(QPainter::Antialiasing, frame.trails.size() <= mostSmooth);
    for (std::size_t body = 0; body < frame.trails.size(); ++body) {
        const bool robot = body < frame.state.robots.size();
        const QColor colour = robot ? robotColour(body) : QColor(255, 255, 255);
        polyline(frame.trails[body], hairline(withAlpha(colour, robot ? 200 : 150)));
    }
    painter_.setRenderHint(QPainter::Antialiasing);
}

void FieldPainter::sensors(const FieldFrame& frame, const FieldFocus& focus) {
    constexpr double farthest = 4;  // m: what has no limit fades towards there
    painter_.setRenderHint(QPainter::Antialiasing, false);
    for (std::size_t robot = 0; robot < frame.state.robots.size(); ++robot) {
        const BodySight& sight = frame.scene().typeOf(robot).perception.objects;
        const bool all = sight.fieldOfView > 2 * std::numbers::pi - 1e-6;
        if (!sight.present || (all && sight.range == 0)) continue;
        const Pose& pose = frame.poseOf(robot);
        const double range = sight.range > 0 ? sight.range : farthest, pixels = range * view_.scale();
        if (!visible(position(pose), range)) continue;
        const QPointF at = view_.toPixels(position(pose));
        const int strength = focus.selected == robot ? 90 : 46;
        QColor colour = robotColour(robot);
        if (sight.range > 0) {
            painter_.setBrush(withAlpha(colour, strength));
        } else {
            QRadialGradient fading(at, pixels);
            fading.setColorAt(0, withAlpha(colour, strength));
            fading.setColorAt(1, withAlpha(colour, 0));
            painter_.setBrush(fading);
        }
        painter_.setPen(Qt::NoPen);
        const QRectF box(at.x() - pixels, at.y() - pixels, 2 * pixels, 2 * pixels);
        const double sixteenth = 16 * 180 / std::numbers::pi;
        if (all)
            painter_.drawEllipse(box);
        else
            painter_.drawPie(box, static_cast<int>(sixteenth * (wrapAngle(pose.heading) - sight.fieldOfView / 2)),
                             static_cast<int>(sixteenth * sight.fieldOfView));
    }
    painter_.setRenderHint(QPainter::Antialiasing);
}

void FieldPainter::ghosts(const FieldFrame& frame) {
    for (const Ghost& ghost : frame.ghosts) {
        for (std::size_t body = 0; body < ghost.trails.size(); ++body) {
            const bool robot = body < frame.state.robots.size();
            const QColor colour = robot ? robotColour(body) : QColor(255, 255, 255);
            polyline(ghost.trails[body], hairline(withAlpha(colour, 130), Qt::DotLine));
        }
        for (std::size_t body = 0; body < ghost.bodies.size(); ++body) {
            const bool robot = body < frame.state.robots.size();
            const QColor colour = robot ? robotColour(body) : QColor(255, 255, 255);
            outline(ghost.scenario->scene().shapeOf(body), ghost.bodies[body], hairline(withAlpha(colour, 170), Qt::DashLine));
        }
    }
}

void FieldPainter::predicted(const FieldFrame& frame, const FieldFocus& focus) {
    for (std::size_t robot = 0; robot < frame.predicted.size(); ++robot) {
        const std::vector<Pose>& poses = frame.predicted[robot];
        std::vector<Point> points;
        points.reserve(poses.size());
        for (const Pose& pose : poses) points.push_back(position(pose));
        const bool selected = focus.selected == robot;
        polyline(points, hairline(selected ? theme_.accent : withAlpha(QColor(255, 255, 255), 190), Qt::DashLine));
        if (poses.empty() || length(points.back() - points.front()) * view_.scale() < 6) continue;
        painter_.setPen(Qt::NoPen);
        painter_.setBrush(selected ? theme_.accent : QColor(255, 255, 255, 220));
        painter_.drawEllipse(view_.toPixels(points.back()), 2.5, 2.5);
    }
}

void FieldPainter::shape(const Shape& shape, const Pose& pose, bool detailed) {
    const Placement at(pose);
    for (const ShapePart& part : shape.parts) {
        const QColor fill = toQColor(part.colour);
        painter_.setBrush(fill);
        painter_.setPen(detailed ? hairline(fill.darker(160)) : QPen(Qt::NoPen));
        if (part.polygon.empty())
            painter_.drawEllipse(view_.toPixels(at.place(part.centre)), part.radius * view_.scale(),
                                 part.radius * view_.scale());
        else
            painter_.drawPolygon(mapped(part.polygon, at));
    }
}

void FieldPainter::outline(const Shape& shape, const Pose& pose, const QPen& pen) {
    const Placement at(pose);
    painter_.setBrush(Qt::NoBrush);
    painter_.setPen(pen);
    for (const ShapePart& part : shape.parts) {
        if (part.polygon.empty())
            painter_.drawEllipse(view_.toPixels(at.place(part.centre)), part.radius * view_.scale(),
                                 part.radius * view_.scale());
        else
            painter_.drawPolygon(mapped(part.polygon, at));
    }
}

void FieldPainter::arrow(const QPointF& from, const QPointF& to, const QColor& colour, double width) {
    const QPointF along = to - from;
    const double size = std::hypot(along.x(), along.y());
    if (size < 1) return;
    const QPointF unit = along / size, across(-unit.y(), unit.x());
    const double head = std::min(size, 3.2 * width);
    const QPointF neck = to - head * unit;
    const QPolygonF polygon({from + width / 2 * across, neck + width / 2 * across, neck + 1.5 * width * across, to,
                             neck - 1.5 * width * across, neck - width / 2 * across, from - width / 2 * across});
    painter_.setBrush(colour);
    painter_.setPen(hairline(QColor(0, 0, 0, 200)));
    painter_.drawPolygon(polygon);
}

void FieldPainter::heading(const Shape& shape, const Pose& pose, const QColor& colour) {
    const double front = std::max(frontOf(shape), 0.5 * shape.reach);
    const Placement at(pose);
    arrow(view_.toPixels(at.place({-0.35 * front, 0})), view_.toPixels(at.place({0.95 * front, 0})), colour,
          std::clamp(0.16 * front * view_.scale(), 1.5, 9.0));
}

void FieldPainter::bodies(const FieldFrame& frame, const FieldFocus& focus) {
    const std::size_t count = frame.scene().bodyCount();
    const bool many = count > mostSmooth;
    painter_.setRenderHint(QPainter::Antialiasing, !many);
    // Objects under robots would be hidden: they come last.
    for (std::size_t body = 0; body < count; ++body) {
        const Shape& what = frame.scene().shapeOf(body);
        const Pose& pose = frame.poseOf(body);
        if (!visible(position(pose), what.reach)) continue;
        const bool robot = body < frame.state.robots.size();
        const double pixels = what.reach * view_.scale();
        if (pixels < leastDetail) {
            painter_.setPen(Qt::NoPen);
            painter_.setBrush(robot ? robotColour(body) : toQColor(what.parts.front().colour));
            const double dot = std::max(2.0, pixels);
            painter_.drawRect(QRectF(view_.toPixels(position(pose)) - QPointF(dot, dot), QSizeF(2 * dot, 2 * dot)));
            continue;
        }
        shape(what, pose, !many);
        if (robot && layers_.has(FieldLayer::headings)) heading(what, pose, robotColour(body));
    }
    painter_.setRenderHint(QPainter::Antialiasing);
    const auto ring = [&](std::size_t body, const QColor& colour, double width) {
        const double radius = frame.scene().shapeOf(body).reach * view_.scale() + 5;
        painter_.setBrush(Qt::NoBrush);
        painter_.setPen(QPen(theme_.halo, width + 2));
        painter_.drawEllipse(view_.toPixels(position(frame.poseOf(body))), radius, radius);
        painter_.setPen(QPen(colour, width));
        painter_.drawEllipse(view_.toPixels(position(frame.poseOf(body))), radius, radius);
    };
    if (focus.hovered && *focus.hovered < count && focus.hovered != focus.selected)
        ring(*focus.hovered, withAlpha(theme_.accent, 140), 1);
    if (focus.selected && *focus.selected < count) {
        ring(*focus.selected, theme_.accent, 2);
        if (focus.moved) {
            const Shape& what = frame.scene().shapeOf(*focus.selected);
            outline(what, *focus.moved, hairline(theme_.accent));
            if (*focus.selected < frame.state.robots.size()) heading(what, *focus.moved, theme_.accent);
        }
    }
}

void FieldPainter::beliefs(const FieldFrame& frame, const FieldFocus& focus) {
    for (std::size_t robot = 0; robot < frame.insights.size(); ++robot) {
        const RobotInsight& insight = frame.insights[robot];
        if (!insight.observed) continue;
        const Observation& seen = insight.observation;
        const QColor colour = robotColour(robot);
        if (seen.localised) {
            outline(frame.scene().shapeOf(robot), seen.self, hairline(colour, Qt::DashLine));
            painter_.setPen(hairline(withAlpha(colour, 160)));
            painter_.drawLine(view_.toPixels(position(frame.poseOf(robot))), view_.toPixels(position(seen.self)));
        }
        if (focus.selected != robot) continue;
        const Placement at(seen.self);
        painter_.setPen(QPen(colour, 2));
        const auto cross = [&](const SeenBody& body) {
            const QPointF p = view_.toPixels(at.place(body.position_B));
            painter_.drawLine(p - QPointF(4, 4), p + QPointF(4, 4));
            painter_.drawLine(p - QPointF(4, -4), p + QPointF(4, -4));
        };
        for (const SeenBody& body : seen.robots) cross(body);
        for (const SeenBody& body : seen.objects) cross(body);
    }
}

void FieldPainter::notes(const FieldFrame& frame, const FieldFocus& focus) {
    for (std::size_t robot = 0; robot < frame.insights.size(); ++robot) {
        const bool selected = focus.selected == robot;
        if (frame.scene().bodyCount() > mostSmooth && !selected) continue;
        const QColor colour = selected ? theme_.accent : withAlpha(robotColour(robot), 210);
        for (const Annotation& note : frame.insights[robot].decision.annotations) {
            if (note.kind == Annotation::Kind::line) polyline(note.points, hairline(colour, Qt::DotLine));
            if (note.kind != Annotation::Kind::point) continue;
            for (const Point& point : note.points) {
                const QPointF at = view_.toPixels(point);
                painter_.setBrush(Qt::NoBrush);
                painter_.setPen(QPen(colour, selected ? 2 : 1));
                painter_.drawEllipse(at, 5, 5);
                painter_.drawLine(at - QPointF(8, 0), at + QPointF(8, 0));
                painter_.drawLine(at - QPointF(0, 8), at + QPointF(0, 8));
                if (selected)
                    label(at + QPointF(9, 0), QString::fromStdString(note.label), theme_.onFloor,
                          Qt::AlignLeft | Qt::AlignVCenter);
            }
        }
    }
}

void FieldPainter::contacts(const FieldFrame& frame) {
    const bool few = frame.contacts.size() <= mostNames;
    for (const ContactReport& contact : frame.contacts) {
        if (!visible(contact.position, 0.5)) continue;
        const QPointF at = view_.toPixels(contact.position);
        // A push of 1 N s is 24 pixels long, of 4 twice that: strong and weak ones are seen side by side.
        const double size = 24 * std::sqrt(contact.impulse);
        const QPointF along = size * QPointF(contact.normal.x, -contact.normal.y);
        painter_.setPen(QPen(theme_.contact, 2));
        painter_.drawLine(at - along, at + along);
        painter_.setPen(hairline(QColor(255, 255, 255)));
        painter_.setBrush(theme_.contact);
        painter_.drawEllipse(at, 3.5, 3.5);
        if (few && contact.impulse >= 0.05)
            label(at + QPointF(8, -10), QString::number(contact.impulse, 'f', 2) + " N s", theme_.contact,
                  Qt::AlignLeft | Qt::AlignVCenter);
    }
}

void FieldPainter::kicks(const FieldFrame& frame) {
    for (const StepTrace::Kicked& kick : frame.kicks) {
        const std::vector<Manipulator>& manipulators = frame.scene().typeOf(kick.robot).manipulators;
        if (kick.manipulator >= manipulators.size()) continue;
        const Manipulator& manipulator = manipulators[kick.manipulator];
        const Placement face(frame.poseOf(kick.robot) *
                             Pose{manipulator.position.x, manipulator.position.y, manipulator.direction});
        const QPointF from = view_.toPixels(face.origin), to = view_.toPixels(face.place({0.35, 0}));
        arrow(from, to, kick.hit ? theme_.kick : withAlpha(theme_.kick, 120), 4);
    }
}

void FieldPainter::names(const FieldFrame& frame, const FieldFocus& focus) {
    std::size_t count = 0;
    for (std::size_t body = 0; body < frame.scene().bodyCount(); ++body)
        count += visible(position(frame.poseOf(body)), 0) ? 1 : 0;
    for (std::size_t body = 0; body < frame.scene().bodyCount(); ++body) {
        const bool looked = focus.selected == body || focus.hovered == body;
        const double reach = frame.scene().shapeOf(body).reach;
        if (!looked && (count > mostNames || reach * view_.scale() < leastDetail)) continue;
        const QPointF below = view_.toPixels(position(frame.poseOf(body))) + QPointF(0, reach * view_.scale() + 4);
        label(below, QString::fromStdString(frame.nameOf(body)), theme_.onFloor, Qt::AlignHCenter | Qt::AlignTop);
    }
}

void FieldPainter::label(const QPointF& at, const QString& text, const QColor& colour, Qt::Alignment where) {
    QFont font = painter_.font();
    font.setPointSizeF(8.5);
    painter_.setFont(font);
    const QFontMetricsF metrics(font);
    QRectF box(0, 0, metrics.horizontalAdvance(text) + 6, metrics.height() + 1);
    if (where & Qt::AlignHCenter)
        box.moveLeft(at.x() - box.width() / 2);
    else
        box.moveLeft(at.x());
    if (where & Qt::AlignVCenter)
        box.moveTop(at.y() - box.height() / 2);
    else
        box.moveTop(at.y());
    painter_.setPen(Qt::NoPen);
    painter_.setBrush(theme_.halo);
    painter_.drawRoundedRect(box, 3, 3);
    painter_.setPen(colour);
    painter_.drawText(box, Qt::AlignCenter, text);
}

void FieldPainter::ruler() {
    const double metres = roundStep(70 / view_.scale()), pixels = metres * view_.scale();
    const QPointF left(16, view_.size().height() - 18), right = left + QPointF(pixels, 0);
    painter_.setRenderHint(QPainter::Antialiasing, false);
    for (const QPen& pen : {QPen(theme_.halo, 4), QPen(theme_.text, 1)}) {
        painter_.setPen(pen);
        painter_.drawLine(left, right);
        painter_.drawLine(left - QPointF(0, 4), left + QPointF(0, 4));
        painter_.drawLine(right - QPointF(0, 4), right + QPointF(0, 4));
    }
    painter_.setRenderHint(QPainter::Antialiasing);
    label((left + right) / 2 - QPointF(0, 21), lengthText(metres), theme_.onFloor, Qt::AlignHCenter | Qt::AlignTop);
}

void FieldPainter::measure(const Point& from, const Point& to) {
    const QPointF a = view_.toPixels(from), b = view_.toPixels(to);
    painter_.setPen(QPen(theme_.halo, 4));
    painter_.drawLine(a, b);
    painter_.setPen(QPen(theme_.accent, 2));
    painter_.drawLine(a, b);
    const Point along = to - from;
    const double degrees = std::atan2(along.y, along.x) * 180 / std::numbers::pi;
    label(b + QPointF(10, -10), lengthText(length(along)) + "   " + QString::number(degrees, 'f', 1) + "\u00b0",
          theme_.onFloor, Qt::AlignLeft | Qt::AlignVCenter);
}

}  // namespace mrose
