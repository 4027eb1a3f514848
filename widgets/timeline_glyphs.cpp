#include "widgets/timeline_glyphs.h"

#include <QObject>
#include <array>
#include <cmath>
#include <numbers>

#include "widgets/timeline_bar.h"

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

void drawMark(QPainter& painter, const QPointF& middle, TimelineMark::Kind kind, const Theme& theme) {
    const QColor colour = TimelineBar::colourOf(kind, theme);
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
        case TimelineMark::Kind::hit:
            painter.drawPolygon(at(middle, {{0, -5.2}, {5.2, 0}, {0, 5.2}, {-5.2, 0}}));
            break;
    }
}

QString markName(TimelineMark::Kind kind) {
    static constexpr std::array<const char*, markKinds> names{"contact",           "kick",           "goal",
                                                              "controller failed", "stop asked for", "breakpoint"};
    return QObject::tr(names[static_cast<std::size_t>(kind)]);
}

QString markLetter(TimelineMark::Kind kind) {
    static constexpr std::array<const char*, markKinds> letters{"\u25cf", "\u25b6", "\u2605",
                                                                "\u2716", "\u25a0", "\u25c6"};
    return QString::fromUtf8(letters[static_cast<std::size_t>(kind)]);
}

}  // namespace mrose
