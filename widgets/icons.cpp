#include "widgets/icons.h"

#include <QPainter>
#include <QPainterPath>

namespace mrose {
namespace {

// In a square of 20 x 20.
void triangle(QPainterPath& path, double x, double width, bool right) {
    const double from = right ? x : x + width, to = right ? x + width : x;
    path.moveTo(from, 4);
    path.lineTo(to, 10);
    path.lineTo(from, 16);
    path.closeSubpath();
}

void bar(QPainterPath& path, double x, double width) { path.addRect(x, 4, width, 12); }

QPainterPath filled(Icon which) {
    QPainterPath path;
    switch (which) {
        case Icon::play:
            triangle(path, 5, 11, true);
            break;
        case Icon::pause:
            bar(path, 4.5, 4);
            bar(path, 11.5, 4);
            break;
        case Icon::tickForward:
            bar(path, 4, 2.5);
            triangle(path, 8.5, 8, true);
            break;
        case Icon::tickBack:
            triangle(path, 3.5, 8, false);
            bar(path, 13.5, 2.5);
            break;
        case Icon::periodForward:
            triangle(path, 3, 7, true);
            triangle(path, 10, 7, true);
            break;
        case Icon::periodBack:
            triangle(path, 3, 7, false);
            triangle(path, 10, 7, false);
            break;
        case Icon::toStart:
            bar(path, 3, 2.5);
            triangle(path, 7, 9.5, false);
            break;
        case Icon::toEnd:
            triangle(path, 3.5, 9.5, true);
            bar(path, 14.5, 2.5);
            break;
        default:
            break;
    }
    return path;
}

void drawOutlined(QPainter& painter, Icon which, const QColor& colour) {
    painter.setPen(QPen(colour, 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.setBrush(Qt::NoBrush);
    if (which == Icon::reset) {
        painter.drawArc(QRectF(4, 4, 12, 12), 50 * 16, 290 * 16);
        painter.setBrush(colour);
        painter.drawPolygon(QPolygonF({{13.4, 2.2}, {16.4, 6.6}, {11.2, 7.0}}));
    } else if (which == Icon::fit) {
        for (const bool right : {false, true})
            for (const bool low : {false, true}) {
                const double x = right ? 17 : 3, y = low ? 16 : 4, inwards = right ? -4 : 4, up = low ? -4 : 4;
                painter.drawPolyline(QPolygonF({{x + inwards, y}, {x, y}, {x, y + up}}));
            }
    } else if (which == Icon::follow) {
        painter.drawEllipse(QPointF(10, 10), 5, 5);
        for (const QPointF& d : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
            painter.drawLine(QPointF(10, 10) + 3.5 * d, QPointF(10, 10) + 8 * d);
    }
}

QPixmap drawn(Icon which, const QColor& colour, double ratio) {
    QPixmap pixmap(static_cast<int>(20 * ratio), static_cast<int>(20 * ratio));
    pixmap.setDevicePixelRatio(ratio);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.fillPath(filled(which), colour);
    drawOutlined(painter, which, colour);
    return pixmap;
}

}  // namespace

QIcon icon(Icon which, const Theme& theme) {
    QIcon made;
    for (const double ratio : {1.0, 2.0}) {
        made.addPixmap(drawn(which, theme.text, ratio));
        made.addPixmap(drawn(which, theme.line, ratio), QIcon::Disabled);
    }
    return made;
}

}  // namespace mrose
