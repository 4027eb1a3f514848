// Messages between robots.
#include <QLineF>
#include <QStringList>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "geometry/polygon.h"
#include "widgets/field_drawing.h"
#include "widgets/field_readout.h"
#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"

namespace mrose {
namespace {

constexpr Nanoseconds messageShown = nanosecondsPerSecond * 4 / 10;
constexpr double asideOfWay = 3;  // pixels to the right: what goes the other way is seen too
constexpr double onLine = 4;      // pixels from it

bool isOf(const RadioLog::Entry& entry, std::optional<std::size_t> robot) {
    return robot == entry.message.from || robot == entry.transmission.to;
}

double shareLeft(const FieldFrame& frame, const RadioLog::Entry& entry) {
    const Nanoseconds age = frame.now() - frame.scene().timeOf(entry.tick);
    return 1 - static_cast<double>(age) / static_cast<double>(messageShown);
}

/// From `size` pixels after the beginning to as many before the end; nothing is left of short ones.
bool shorten(QPointF& from, QPointF& to, double atBeginning, double atEnd) {
    const QPointF along = to - from;
    const double size = std::hypot(along.x(), along.y());
    if (size < atBeginning + atEnd + 4) return false;
    from += atBeginning / size * along;
    to -= atEnd / size * along;
    return true;
}

double reachOf(const FieldFrame& frame, std::size_t robot) { return frame.scene().typeOf(robot).shape->reach; }

/// In pixels, between the outlines of both robots; nothing where these are too near to each other.
std::optional<QLineF> lineOf(const ViewTransform& view, const FieldFrame& frame, const RadioLog::Entry& entry) {
    QPointF from = view.toPixels(entry.message.position), to = view.toPixels(entry.transmission.position);
    const QPointF line = to - from;
    const double size = std::hypot(line.x(), line.y());
    if (size < 1) return std::nullopt;
    const QPointF right = asideOfWay / size * QPointF(-line.y(), line.x());
    from += right, to += right;
    const auto reach = [&](std::size_t robot) { return view.scale() * reachOf(frame, robot); };
    if (!shorten(from, to, reach(entry.message.from), reach(entry.transmission.to) + 2)) return std::nullopt;
    return QLineF(from, to);
}

QString messageReadout(const FieldFrame& frame, const RadioLog::Entry& entry) {
    return QObject::tr("%1 to %2, sent at %3: %4")
        .arg(qtText(frame.nameOf(entry.message.from)), qtText(frame.nameOf(entry.transmission.to)),
             clockText(frame.scene().timeOf(entry.message.tick)), messageText(frame, entry));
}

}  // namespace

std::vector<const RadioLog::Entry*> shownMessages(const FieldFrame& frame, const FieldFocus& focus) {
    const bool all = frame.state.robots.size() <= mostNames;
    std::map<std::pair<std::uint32_t, std::uint32_t>, const RadioLog::Entry*> newest;
    for (const RadioLog::Entry& entry : frame.radio.due)
        if (shareLeft(frame, entry) > 0 && (all || isOf(entry, focus.selected)) && !focus.isQuiet(entry.message.from))
            newest[{entry.message.from, entry.transmission.to}] = &entry;
    std::vector<const RadioLog::Entry*> shown;
    for (const auto& [pair, entry] : newest) shown.push_back(entry);
    std::stable_partition(shown.begin(), shown.end(),
                          [&](const RadioLog::Entry* entry) { return !isOf(*entry, focus.selected); });
    return shown;
}

void drawMessage(const FieldCanvas& canvas, const QPointF& from, const QPointF& to, const QColor& colour, double width,
                 Transmission::Outcome outcome, double end) {
    const QPointF line = to - from;
    const double size = std::hypot(line.x(), line.y());
    if (size < 1) return;
    const QPointF along = line / size, across(-along.y(), along.x());
    QPen solid = roundPen(colour, width), broken = roundPen(colour, width, Qt::CustomDashLine);
    broken.setDashPattern({2.5, 2.5});
    const auto dash = [&](const QPointF& until) {
        canvas.painter.setPen(broken);  // a casing would fill the gaps
        canvas.painter.drawLine(from, until);
    };
    switch (outcome) {
        case Transmission::Outcome::received:
            canvas.casedLine(from, to - 2 * width * along, solid);
            canvas.painter.setBrush(colour);
            canvas.painter.setPen(roundPen(withAlpha(setOff(colour), colour.alpha() / 2), 0.8));
            canvas.painter.drawPolygon(QPolygonF(
                {to, to - 4 * width * along + 1.9 * width * across, to - 4 * width * along - 1.9 * width * across}));
            break;
        case Transmission::Outcome::lost: {
            dash(to);
            constexpr double arm = 4;
            const QPointF middle = from + 0.5 * line;
            for (const QPointF& way : {along + across, along - across})
                canvas.casedLine(middle - arm * way, middle + arm * way, solid);
            break;
        }
        case Transmission::Outcome::outOfRange: {
            constexpr double arm = 5;
            const QPointF last = from + std::min(end, size) * along;
            dash(last);
            canvas.casedLine(last - arm * across, last + arm * across, solid);
            break;
        }
    }
}

void drawRadio(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus) {
    for (const RadioLog::Entry* const entry : shownMessages(frame, focus)) {
        const auto line = lineOf(canvas.view, frame, *entry);
        if (!line) continue;
        const bool strong = isOf(*entry, focus.selected);
        const double left = shareLeft(frame, *entry), most = strong || !focus.selected ? 255 : 130;
        const QColor colour = robotColour(frame.scene(), entry->message.from);
        drawMessage(canvas, line->p1(), line->p2(), withAlpha(colour, static_cast<int>(most * (0.35 + 0.65 * left))),
                    strong ? 2.4 : 1.7, entry->transmission.outcome,
                    canvas.pixels(frame.scene().radio.range - reachOf(frame, entry->message.from)));
    }
}

QString radioReadout(const ViewTransform& view, const FieldFrame& frame, const FieldFocus& focus,
                     const QPointF& pixels) {
    QStringList lines;
    for (const RadioLog::Entry* const entry : shownMessages(frame, focus)) {
        const auto line = lineOf(view, frame, *entry);
        if (!line) continue;
        const double far =
            distanceToSegment({pixels.x(), pixels.y()}, {line->x1(), line->y1()}, {line->x2(), line->y2()});
        if (far <= onLine) lines += messageReadout(frame, *entry);
    }
    return lines.join('\n');
}

}  // namespace mrose
