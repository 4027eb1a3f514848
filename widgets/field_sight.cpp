#include <algorithm>
#include <cmath>
#include <numbers>

#include "sensing/sensor.h"
#include "widgets/field_drawing.h"

namespace mrose {
namespace {

constexpr double farthest = 4;  // m: what has no limit fades towards there
constexpr double rayTurn = std::numbers::pi / 180;

bool hasLimits(const BodySight& sight) {
    return sight.present && (sight.range > 0 || sight.fieldOfView < 2 * std::numbers::pi - 1e-6);
}

}  // namespace

std::vector<const BodySight*> sightsOf(const RobotType& type) {
    std::vector<const BodySight*> sights;
    for (const BodySight* sight : {&type.perception.objects, &type.perception.robots})
        if (sights.empty() && hasLimits(*sight)) sights.push_back(sight);
    for (const auto& sensor : type.sensors)
        if (const BodySight* sight = sensor->sight(); sight != nullptr && hasLimits(*sight)) sights.push_back(sight);
    return sights;
}

namespace {

/// How far along a ray of length 1 a piece begins, if nearer than `least`.
double hit(const ConvexPiece& piece, const Point& from, const Point& along, double least) {
    const Point to = piece.centre - from;
    const double ahead = to.x * along.x + to.y * along.y, aside = to.x * along.y - to.y * along.x;
    if (std::abs(aside) > piece.reach || ahead < -piece.reach || ahead - piece.reach > least) return least;
    if (piece.isCircle()) {
        const double half = std::sqrt(std::max(0.0, piece.radius * piece.radius - aside * aside));
        return ahead - half > 0 ? std::min(least, ahead - half) : least;
    }
    for (std::size_t i = 0; i < piece.count; ++i) {
        const Point a = piece.corners[i] - from, edge = piece.corners[(i + 1) % piece.count] - piece.corners[i];
        const double cross = along.x * edge.y - along.y * edge.x;
        if (cross == 0) continue;
        const double distance = (a.x * edge.y - a.y * edge.x) / cross, share = (a.x * along.y - a.y * along.x) / cross;
        if (distance > 0 && share >= 0 && share <= 1) least = std::min(least, distance);
    }
    return least;
}

/// What is seen from a pose, around which walls are opaque if `sight` says so.
QPolygonF seenArea(const FieldCanvas& canvas, const Environment& environment, const BodySight& sight, const Pose& pose,
                   double range) {
    const bool allRound = sight.fieldOfView > 2 * std::numbers::pi - 1e-6;
    std::vector<const ConvexPiece*> near;
    if (sight.occlusion)
        for (const Obstacle& obstacle : environment.obstacles)
            for (const ConvexPiece& piece : obstacle.shape.pieces)
                if (distance(piece.centre, position(pose)) - piece.reach < range) near.push_back(&piece);
    QPolygonF area;
    if (!allRound) area.append(canvas.at(position(pose)));
    const int rays = std::max(2, static_cast<int>(std::ceil(sight.fieldOfView / rayTurn)));
    for (int i = 0; i <= rays; ++i) {
        const double angle = pose.heading + sight.direction + sight.fieldOfView * (static_cast<double>(i) / rays - 0.5);
        const Point along{std::cos(angle), std::sin(angle)};
        double least = range;
        for (const ConvexPiece* piece : near) least = hit(*piece, position(pose), along, least);
        area.append(canvas.at(position(pose) + least * along));
    }
    return area;
}

}  // namespace

void drawSensors(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus) {
    QPainter& painter = canvas.painter;
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setPen(Qt::NoPen);
    for (std::size_t robot = 0; robot < frame.state.robots.size(); ++robot)
        for (const BodySight* sight : sightsOf(frame.scene().typeOf(robot))) {
            const Pose& pose = frame.poseOf(robot);
            const double range = sight->range == 0 ? farthest : sight->range;
            if (!canvas.visible(position(pose), range)) continue;
            const QColor colour = withAlpha(robotColour(frame.scene(), robot), focus.selected == robot ? 90 : 46);
            painter.setBrush(colour);
            if (sight->range == 0) {
                QRadialGradient fading(canvas.at(position(pose)), canvas.pixels(range));
                fading.setColorAt(0, colour);
                fading.setColorAt(1, withAlpha(colour, 0));
                painter.setBrush(fading);
            }
            painter.drawPolygon(seenArea(canvas, frame.scene().environment, *sight, pose, range));
        }
    painter.setRenderHint(QPainter::Antialiasing);
}

}  // namespace mrose
