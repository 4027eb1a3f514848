#include <QFontMetricsF>
#include <algorithm>
#include <cmath>

#include "debug/real_robot.h"
#include "widgets/field_drawing.h"
#include "widgets/field_readout.h"
#include "widgets/qt_text.h"

namespace mrose {
namespace {

constexpr double chipSize = 7, padding = 4, chipGap = 4;  // pixels
constexpr double quietOpacity = 0.7;
constexpr double mostNamed = 0.04;  // of one of two fields

/// From a label that had to go far away to what it names.
void drawLeader(const FieldCanvas& canvas, const QRectF& box, const FieldLabel& label) {
    const QPointF to = canvas.at(label.at);
    const QPointF from(std::clamp(to.x(), box.left(), box.right()), std::clamp(to.y(), box.top(), box.bottom()));
    const QPointF along = to - from;
    const double size = std::hypot(along.x(), along.y()), shown = size - label.clearance;
    if (shown > 4) canvas.casedLine(from, from + shown / size * along, roundPen(canvas.theme.onFloor, 1));
}

/// A robot's colour: a disc beside its name, the sign of a note beside what it thinks.
void drawChip(const FieldCanvas& canvas, const QPointF& middle, const FieldLabel& label) {
    canvas.painter.setPen(roundPen(withAlpha(setOff(*label.chip), 150), 1));
    canvas.painter.setBrush(*label.chip);
    if (!label.note) return canvas.painter.drawEllipse(middle, chipSize / 2, chipSize / 2);
    for (const QPen& pen : {roundPen(setOff(*label.chip), 3), roundPen(*label.chip, 1.6)}) {
        canvas.painter.setPen(pen);
        canvas.painter.drawLine(middle - QPointF(chipSize / 2, 0), middle + QPointF(chipSize / 2, 0));
        canvas.painter.drawLine(middle - QPointF(0, chipSize / 2), middle + QPointF(0, chipSize / 2));
    }
}

}  // namespace

QFont plateFont(const QPainter& painter, bool note) {
    QFont font = painter.font();
    font.setPointSizeF(8.5);
    font.setItalic(note);
    return font;
}

QSizeF plateSize(const FieldCanvas& canvas, const FieldLabel& label) {
    const QFontMetricsF metrics(plateFont(canvas.painter, label.note));
    const double chip = label.chip ? chipSize + chipGap : 0;
    return {std::ceil(metrics.horizontalAdvance(label.text) + chip + 2 * padding), std::ceil(metrics.height()) + 1};
}

void drawPlate(const FieldCanvas& canvas, const QRectF& box, const FieldLabel& label) {
    QPainter& painter = canvas.painter;
    painter.setOpacity(label.quiet ? quietOpacity : 1);
    painter.setPen(Qt::NoPen);
    painter.setBrush(canvas.theme.halo);
    painter.drawRoundedRect(box, 3, 3);
    QRectF text = box.adjusted(padding, 0, -padding, 0);
    if (label.chip) {
        const QPointF middle(text.left() + chipSize / 2, box.center().y());
        drawChip(canvas, middle, label);
        text.setLeft(text.left() + chipSize + chipGap);
    }
    painter.setFont(plateFont(painter, label.note));
    painter.setPen(label.colour);
    painter.drawText(text, Qt::AlignLeft | Qt::AlignVCenter, label.text);
    painter.setOpacity(1);
}

void addNames(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
              std::vector<FieldLabel>& labels) {
    constexpr double leastReach = 5;  // pixels: whose bodies are smaller are nameless
    const auto isLooked = [&](std::size_t body) { return focus.selected == body || focus.hovered == body; };
    const auto isElsewhere = [&](std::size_t body) { return body < focus.elsewhere.size() && focus.elsewhere[body]; };
    std::vector<std::size_t> bodies = visibleBodies(canvas, frame);
    // Where two fields share the room, those that differ come first, and no more than leave the field to be seen.
    const bool shared = !focus.elsewhere.empty();
    double room = mostNamed * canvas.view.size().width() * canvas.view.size().height();
    if (shared) std::stable_partition(bodies.begin(), bodies.end(), isElsewhere);
    std::stable_partition(bodies.begin(), bodies.end(), isLooked);
    for (const std::size_t body : bodies) {
        const bool looked = isLooked(body);
        const double reach = canvas.pixels(frame.scene().shapeOf(body).reach);
        if (!looked && (bodies.size() > mostNames || reach < leastReach || (shared && room < 0))) continue;
        FieldLabel& label = labels.emplace_back();
        label.key = std::uint64_t{1} << 56 | body;
        label.at = position(frame.poseOf(body));
        label.clearance = reach + (looked ? 7 : 0);
        label.text = qtText(frame.nameOf(body));
        label.colour = canvas.theme.onFloor;
        if (std::find(frame.failed.begin(), frame.failed.end(), body) != frame.failed.end()) {
            label.text += QObject::tr(": failed");
            label.colour = canvas.theme.warning;
        }
        if (body < frame.state.robots.size()) label.chip = robotColour(frame.scene(), body);
        label.first = looked;
        label.last = isElsewhere(body);
        label.quiet = focus.isQuiet(body);
        const QSizeF size = plateSize(canvas, label);
        room -= size.width() * size.height();
    }
}

void drawLabels(const FieldCanvas& canvas, const FieldFrame& frame, std::vector<FieldLabel> labels, LabelPlacer& placer,
                const std::vector<QRectF>& kept) {
    placer.begin(QRectF(QPointF(0, 0), canvas.view.size()).adjusted(2, 2, -2, -2));
    for (const QRectF& box : kept) placer.keepFree(box);
    if (labels.empty()) return;
    const auto avoid = [&](const Shape& shape, const Pose& pose) {
        const double half = 0.85 * canvas.pixels(shape.reach);
        placer.avoid({canvas.at(position(pose)) - QPointF(half, half), QSizeF(2 * half, 2 * half)});
    };
    for (const std::size_t body : visibleBodies(canvas, frame)) avoid(frame.scene().shapeOf(body), frame.poseOf(body));
    for (const RealRobot& real : realRobots(frame)) avoid(*real.shape, real.pose);
    std::stable_partition(labels.begin(), labels.end(), [](const FieldLabel& label) { return !label.last; });
    std::stable_partition(labels.begin(), labels.end(), [](const FieldLabel& label) { return label.first; });
    for (const FieldLabel& label : labels) {
        const auto place = placer.place({label.key, canvas.at(label.at), label.clearance, plateSize(canvas, label)});
        if (!place) continue;
        if (place->far) drawLeader(canvas, place->box, label);
        drawPlate(canvas, place->box, label);
    }
}

}  // namespace mrose
