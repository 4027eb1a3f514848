#include "widgets/timeline_glyphs.h"

#include <QObject>
#include <array>
#include <cmath>
#include <numbers>

namespace mrose {
namespace {

QPolygonF star(const QPointF& middle, double radius) {
    QPolygonF points;
    for (int i = 0; i < 10; ++i) {
        const double angle = -std::numbers::pi / 2 + i * std::numbers::pi / 5, r = i % 2 == 0 ? radius : 0.45 * radius;
        points.append(middle + r * QPointF(std::cos(angle), std::sin(angle)));
    }
    return points;
}

QPolygonF at(const QPointF& middle, std::initializer_list<QPointF> corners) {
    QPolygonF points;
    for (const QPointF& corner : corners) points.append(middle + corner);
    return points;
}

}  // namespace

QColor markColour(TimelineMark::Kind kind, const Theme& theme) {
    switch (kind) {
        case TimelineMark::Kind::contact:
            return theme.contact;
        case TimelineMark::Kind::kick:
            return theme.dark ? QColor(240, 228, 66) : QColor(176, 132, 0);
        case TimelineMark::Kind::goal:
            return theme.dark ? QColor(40, 210, 150) : QColor(0, 158, 115);
        case TimelineMark::Kind::fault:
            return theme.warning;
        case TimelineMark::Kind::divergence:
            return theme.dark ? QColor(90, 210, 220) : QColor(0, 120, 140);
        case TimelineMark::Kind::hit:
            return theme.dark ? QColor(200, 150, 255) : QColor(120, 50, 190);
        case TimelineMark::Kind::stop:
            break;
    }
    return theme.accent;
}

void drawMark(QPainter& painter, const QPointF& middle, TimelineMark::Kind kind, const Theme& theme) {
    const QColor colour = markColour(kind, theme);
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    switch (kind) {
        case TimelineMark::Kind::contact:
            painter.drawEllipse(middle, 3, 3);
            break;
        case TimelineMark::Kind::kick:
            painter.drawPolygon(at(middle, {{-4.5, -4}, {4.5, 0}, {-4.5, 4}}));
            break;
        case TimelineMark::Kind::goal:
            painter.drawPolygon(star(middle, 5.5));
            break;
        case TimelineMark::Kind::fault:
            painter.setPen(QPen(colour, 2.2, Qt::SolidLine, Qt::RoundCap));
            painter.drawLine(middle - QPointF(3.2, 3.2), middle + QPointF(3.2, 3.2));
            painter.drawLine(middle - QPointF(3.2, -3.2), middle + QPointF(3.2, -3.2));
            break;
        case TimelineMark::Kind::stop:
            painter.drawPolygon(at(middle, {{-1.9, -4.5},
                                            {1.9, -4.5},
                                            {4.5, -1.9},
                                            {4.5, 1.9},
                                            {1.9, 4.5},
                                            {-1.9, 4.5},
                                            {-4.5, 1.9},
                                            {-4.5, -1.9}}));
            break;
        case TimelineMark::Kind::divergence:
            // Two ways that part.
            painter.setPen(QPen(colour, 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
            painter.setBrush(Qt::NoBrush);
            painter.drawPolyline(at(middle, {{-5, 0}, {-1, 0}, {4.5, -4}}));
            painter.drawPolyline(at(middle, {{-1, 0}, {4.5, 4}}));
            break;
        case TimelineMark::Kind::hit:
            painter.drawPolygon(at(middle, {{0, -5.2}, {5.2, 0}, {0, 5.2}, {-5.2, 0}}));
            break;
    }
}

QString markName(TimelineMark::Kind kind) {
    static constexpr std::array<const char*, markKinds> names{
        "contact", "kick", "goal", "controller failed", "stop asked for", "breakpoint", "first divergence"};
    return QObject::tr(names[static_cast<std::size_t>(kind)]);
}

QString markLetter(TimelineMark::Kind kind) {
    static constexpr std::array<const char*, markKinds> letters{"\u25cf", "\u25b6", "\u2605", "\u2716",
                                                                "\u25a0", "\u25c6", "\u2442"};
    return QString::fromUtf8(letters[static_cast<std::size_t>(kind)]);
}

}  // namespace mrose
