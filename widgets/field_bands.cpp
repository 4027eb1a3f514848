#include <QObject>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "widgets/field_drawing.h"
#include "widgets/field_readout.h"

namespace mrose {
namespace {

/// How far ahead the bands of all of a run are shown.
constexpr Nanoseconds aheadOfRun = 5 * nanosecondsPerSecond;
constexpr double leastPiece = 8;  // pixels, along the way
constexpr int outerAlpha = 84, innerAlpha = 120, ringAlpha = 220;
constexpr double floorContrast = 1.3;
/// Of the others, where one is selected.
constexpr double quietShare = 0.45;

QPainterPath swathPath(const FieldCanvas& canvas, std::span<const PoseRegion> regions, RegionShare share) {
    QPainterPath path;
    path.setFillRule(Qt::WindingFill);
    for (const Polygon& piece : swathOf(regions, share, leastPiece / canvas.view.scale())) {
        QPolygonF mapped;
        for (const Point& corner : piece) mapped.append(canvas.at(corner));
        path.addPolygon(mapped);
        path.closeSubpath();
    }
    return path;
}

QPolygonF regionOutline(const FieldCanvas& canvas, const PoseRegion& region, RegionShare share) {
    QPolygonF outline;
    for (const Point& corner : region.outline(share, 48)) outline.append(canvas.at(corner));
    return outline;
}

/// Rings that are too small to be told from a point are left out.
void drawRegionRing(const FieldCanvas& canvas, const PoseRegion& region, RegionShare share, const QPen& pen) {
    constexpr double leastRing = 3;  // pixels
    if (canvas.pixels(region.semiAxes(share).first) < leastRing) return;
    canvas.painter.setBrush(Qt::NoBrush);
    canvas.painter.setPen(pen);
    canvas.painter.drawPolygon(regionOutline(canvas, region, share));
}

QColor bandColour(const FieldCanvas& canvas, const FieldFrame& frame, std::size_t robot) {
    return seenOn(floorColour(frame.scene().environment, canvas.theme), robotColour(frame.scene(), robot),
                  floorContrast);
}

struct BandTicks {
    std::int64_t from = 0, to = 0;
};

BandTicks shownTicks(const FieldFrame& frame, const RobotBands& bands) {
    const std::int64_t now = frame.state.tick;
    if (!bands.ofRun) return {now, bands.bands->last()};
    const auto behind = static_cast<std::int64_t>(frame.trails.ticks());
    return {now - behind, now + frame.scene().ticksOf(aheadOfRun)};
}

/// At whole seconds, or every 2, 5, 10: as many as can be told apart.
std::vector<const PoseRegion*> ringsOf(const FieldCanvas& canvas, const FieldFrame& frame, const MotionBands& bands,
                                       std::size_t robot) {
    constexpr double leastApart = 22;  // pixels
    const std::int64_t start = bands.tick, end = bands.last();
    std::vector<const PoseRegion*> rings;
    for (const int seconds : {1, 2, 5, 10, 20}) {
        const std::int64_t step = frame.scene().ticksOf(seconds * nanosecondsPerSecond);
        const PoseRegion* before = bands.at(robot, start);
        double nearest = std::numeric_limits<double>::infinity();
        rings.clear();
        for (std::int64_t tick = start + step; tick <= end && before != nullptr; tick += step) {
            const PoseRegion* const region = bands.at(robot, tick);
            if (region == nullptr) break;
            nearest = std::min(nearest, canvas.pixels(distance(region->centre, before->centre)));
            rings.push_back(before = region);
        }
        if (nearest >= leastApart) break;
    }
    return rings;
}

void drawBandOf(const FieldCanvas& canvas, const FieldFrame& frame, const RobotBands& bands, std::size_t robot,
                double strength) {
    const auto [from, to] = shownTicks(frame, bands);
    const std::span<const PoseRegion> regions = bands.bands->between(robot, from, to);
    if (regions.empty()) return;
    const QColor colour = bandColour(canvas, frame, robot);
    // Its edge is drawn, too.
    drawBand(canvas.painter, swathPath(canvas, regions, RegionShare::most).simplified(),
             swathPath(canvas, regions, RegionShare::half), colour, strength);
    const QPen pen = roundPen(withAlpha(colour, static_cast<int>(strength * ringAlpha)), 1);
    // Beside a real robot it is of interest where it may be now.
    if (bands.ofRun) return;
    for (const PoseRegion* const region : ringsOf(canvas, frame, *bands.bands, robot))
        drawRegionRing(canvas, *region, RegionShare::most, pen);
}

}  // namespace

bool RobotBands::tellOf(const FieldFrame& frame) const {
    if (!bands || bands->regions.size() != frame.state.robots.size()) return false;
    return frame.state.tick >= bands->tick && (bands->empty() || frame.state.tick <= bands->last());
}

void drawBand(QPainter& painter, const QPainterPath& outer, const QPainterPath& inner, const QColor& colour,
              double strength) {
    painter.setPen(roundPen(withAlpha(colour, static_cast<int>(strength * ringAlpha)), 1));
    painter.setBrush(withAlpha(colour, static_cast<int>(strength * outerAlpha)));
    painter.drawPath(outer);
    painter.setPen(Qt::NoPen);
    painter.setBrush(withAlpha(colour, static_cast<int>(strength * innerAlpha)));
    painter.drawPath(inner);
}

void drawBands(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus) {
    if (!focus.bands.tellOf(frame)) return;
    const std::size_t robots = frame.state.robots.size();
    const bool one = focus.selected && *focus.selected < robots;
    for (std::size_t robot = 0; robot < robots; ++robot)
        if (!one || robot != *focus.selected) drawBandOf(canvas, frame, focus.bands, robot, one ? quietShare : 1);
    if (one) drawBandOf(canvas, frame, focus.bands, *focus.selected, 1);
}

void drawRegionsNow(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus) {
    if (!focus.bands.ofRun || !focus.bands.tellOf(frame)) return;
    for (std::size_t robot = 0; robot < frame.state.robots.size(); ++robot)
        if (const PoseRegion* const region = focus.bands.bands->at(robot, frame.state.tick)) {
            const QColor colour = bandColour(canvas, frame, robot);
            for (const auto& [share, width] : {std::pair(RegionShare::most, 1.8), std::pair(RegionShare::half, 1.2)})
                for (const QPen& pen : {roundPen(withAlpha(setOff(colour), 150), width + 1.6), roundPen(colour, width)})
                    drawRegionRing(canvas, *region, share, pen);
        }
}

std::optional<PlacedLabel> bandLabel(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus) {
    if (!focus.selected || focus.bands.ofRun || !focus.bands.tellOf(frame)) return {};
    const std::int64_t now = frame.state.tick, last = focus.bands.bands->last();
    const PoseRegion* const end = focus.bands.bands->at(*focus.selected, last);
    if (end == nullptr || !canvas.visible(end->centre, 0)) return {};
    FieldLabel label;
    const double ahead = toSeconds((last - now) * frame.scene().tickLength);
    label.text = QObject::tr("in %1 s").arg(ahead, 0, 'f', ahead == std::round(ahead) ? 0 : 1);
    label.colour = canvas.theme.onFloor;
    // Beyond the end, off the band.
    const Polygon outline = end->outline(RegionShare::most);
    const PoseRegion* const before = focus.bands.bands->at(*focus.selected, last - focus.bands.bands->every);
    const QPointF from = canvas.at(before != nullptr ? before->centre : end->centre), to = canvas.at(end->centre);
    const double size = std::hypot((to - from).x(), (to - from).y());
    const QPointF along = size > 0 ? (to - from) / size : QPointF(0, -1);
    double reach = 0;
    for (const Point& corner : outline) reach = std::max(reach, QPointF::dotProduct(canvas.at(corner) - to, along));
    const QSizeF plate = plateSize(canvas, label);
    const double half = std::abs(along.x()) * plate.width() / 2 + std::abs(along.y()) * plate.height() / 2;
    const QPointF middle = to + (reach + half + 4) * along;
    return PlacedLabel{QRectF(middle - QPointF(plate.width(), plate.height()) / 2, plate), label};
}

QString bandReadout(const FieldFrame& frame, const RobotBands& bands, std::size_t body) {
    if (body >= frame.state.robots.size() || !bands.tellOf(frame)) return {};
    if (bands.bands->regions[body].empty()) return QObject::tr("no noise of its motion is known");
    const std::int64_t last = bands.bands->last();
    const std::int64_t tick = bands.ofRun ? frame.state.tick : last;
    const PoseRegion& region = *bands.bands->at(body, tick);
    const auto text = [&](RegionShare share) {
        const auto [length, width] = region.semiAxes(share);
        const PoseRegion::Interval& heading = region.of(share).heading;
        const double turned = 90 * (heading.high - heading.low) / std::numbers::pi;
        return QObject::tr("%1 %: \u00b1%2 by \u00b1%3, \u00b1%4\u00b0")
            .arg(100 * regionShares[static_cast<std::size_t>(share)], 0, 'f', 0)
            .arg(lengthText(length), lengthText(width))
            .arg(turned, 0, 'f', 1);
    };
    const double seconds =
        toSeconds((tick - (bands.ofRun ? bands.bands->tick : frame.state.tick)) * frame.scene().tickLength);
    const QString when =
        bands.ofRun ? QObject::tr("may be now, %1 s after the rollout's start") : QObject::tr("may be in %1 s");
    return when.arg(seconds, 0, 'f', 1) + "\n  " + text(RegionShare::half) + "\n  " + text(RegionShare::most);
}

}  // namespace mrose
