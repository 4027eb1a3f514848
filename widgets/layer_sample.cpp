#include "widgets/layer_sample.h"

#include <array>

#include "widgets/field_drawing.h"

namespace mrose {
namespace {

constexpr double inset = 3;  // pixels

QPolygonF across(const QRectF& box) {
    const double y = box.center().y();
    return QVector<QPointF>{{box.left() + inset, y}, {box.right() - inset, y}};
}

void drawPath(const FieldCanvas& canvas, const QRectF& box, const QColor& colour) {
    QPen pen = roundPen(colour, 1.6, Qt::CustomDashLine);
    pen.setDashPattern({4, 2.5});
    canvas.casedLine(across(box), pen);
    canvas.painter.setPen(roundPen(withAlpha(setOff(colour), 150), 1));
    canvas.painter.setBrush(colour);
    canvas.painter.drawEllipse(across(box).back() - QPointF(2, 0), 2.6, 2.6);
}

void drawOutlineSample(const FieldCanvas& canvas, const QRectF& box, const QColor& colour, bool filled) {
    const double radius = box.height() / 2 - 1;
    canvas.painter.setBrush(filled ? QBrush(withAlpha(colour, 70)) : QBrush(Qt::NoBrush));
    if (!filled) {
        canvas.painter.setPen(roundPen(withAlpha(setOff(colour), 110), 2.6));
        canvas.painter.drawEllipse(box.center(), radius, radius);
    }
    canvas.painter.setPen(roundPen(colour, 1.4, Qt::DashLine));
    canvas.painter.drawEllipse(box.center(), radius, radius);
}

void drawRing(const FieldCanvas& canvas, const QRectF& box, const QColor& colour, double width) {
    const double radius = box.height() / 2 - 2;
    canvas.painter.setBrush(Qt::NoBrush);
    for (const QPen& pen : {roundPen(withAlpha(setOff(colour), 190), width + 1.8), roundPen(colour, width)}) {
        canvas.painter.setPen(pen);
        canvas.painter.drawEllipse(QPointF(box.right() - inset - radius, box.center().y()), radius, radius);
    }
}

/// An outline at the end of a hollow way.
void drawRealSample(const FieldCanvas& canvas, const QRectF& box, const QColor& colour) {
    canvas.painter.setPen(roundPen(colour, 1));
    const double right = box.right() - inset - box.height() + 4;
    for (const double side : {-1.8, 1.8})
        canvas.painter.drawLine(QPointF(box.left() + inset, box.center().y() + side),
                                QPointF(right, box.center().y() + side));
    drawRing(canvas, box, colour, 2);
}

/// A simulated reading, and below it a real one, of one sensor.
void drawReadingSample(const FieldCanvas& canvas, const QRectF& box, const QColor& colour) {
    constexpr double apart = 3.8, radius = 2.4;
    const QPointF eye(box.left() + inset, box.center().y());
    for (const bool real : {false, true}) {
        QPen pen = roundPen(colour, 1.1, real ? Qt::CustomDashLine : Qt::SolidLine);
        if (real) pen.setDashPattern({3, 2.5});
        canvas.painter.setPen(pen);
        const QPointF to(box.right() - inset - radius, eye.y() + (real ? apart : -apart));
        canvas.painter.drawLine(eye, to);
        drawReadingMark(canvas, to, colour, real, radius);
    }
}

/// A message that was received, and below it one that was lost.
void drawRadioSample(const FieldCanvas& canvas, const QRectF& box, const QColor& colour) {
    constexpr double apart = 3.6;
    const QPolygonF line = across(box);
    for (const bool lost : {false, true}) {
        const QPointF off(0, lost ? apart : -apart);
        drawMessage(canvas, line.front() + off, line.back() + off, colour, 1.4,
                    lost ? Transmission::Outcome::lost : Transmission::Outcome::received, 0);
    }
}

/// Beams from the left end of the box that met something.
void drawLaserSample(const FieldCanvas& canvas, const QRectF& box, const QColor& colour) {
    const QPointF eye(box.left() + inset, box.center().y());
    QPolygonF ends;
    for (int i = -3; i <= 3; ++i) ends.append(QPointF(box.right() - inset - (i < 0 ? 5 : 0), eye.y() + 2 * i));
    canvas.painter.setPen(Qt::NoPen);
    canvas.painter.setBrush(withAlpha(colour, 70));
    canvas.painter.drawPolygon(QPolygonF(ends) << eye);
    canvas.painter.setBrush(colour);
    for (const QPointF& end : ends) canvas.painter.drawRect(QRectF(end - QPointF(1, 1), QSizeF(2, 2)));
}

/// Segments of which one is pressed.
void drawBumperSample(const FieldCanvas& canvas, const QRectF& box) {
    const double width = (box.width() - 2 * inset) / 3;
    for (int i = 0; i < 3; ++i) {
        const QPointF from(box.left() + inset + i * width + 1.5, box.center().y());
        drawBumperSegment(canvas, QVector<QPointF>{from, from + QPointF(width - 3, 0)}, i == 1);
    }
}

constexpr int sampleHalf = 16 * 16;  // 1/16 degree

/// About the left end of the box, up to a share of its width.
QRectF circleIn(const QRectF& box, double share = 1) {
    const double radius = share * (box.width() - 2 * inset);
    const QPointF eye(box.left() + inset, box.center().y());
    return {eye - QPointF(radius, radius), 2 * QSizeF(radius, radius)};
}

/// A row of pixels.
void drawRowSample(const FieldCanvas& canvas, const QRectF& box) {
    constexpr std::array row{ColourClass::floor, ColourClass::ball, ColourClass::floor, ColourClass::yellowGoal,
                             ColourClass::wall};
    const double width = (box.width() - 2 * inset) / static_cast<double>(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
        const QPointF from(box.left() + inset + static_cast<double>(i) * width, box.center().y());
        drawPixelStrip(canvas, QVector<QPointF>{from, from + QPointF(width, 0)}, row[i]);
    }
}

/// Bands that widen from the left end of the box on.
void drawBandSample(QPainter& painter, const QRectF& box, const QColor& colour) {
    const auto widening = [&](double half) {
        const QPointF from(box.left() + inset, box.center().y()), to(box.right() - inset - half, box.center().y());
        QPainterPath path(from);
        path.lineTo(to + QPointF(0, half));
        path.arcTo(QRectF(to - QPointF(half, half), 2 * QSizeF(half, half)), -90, 180);
        path.closeSubpath();
        return path;
    };
    const double half = box.height() / 2 - 1;
    drawBand(painter, widening(half), widening(0.45 * half), colour);
}

/// A field of view from the left end of the box on.
void drawSector(QPainter& painter, const QRectF& box, double share = 1) {
    painter.drawPie(circleIn(box, share), -sampleHalf, 2 * sampleHalf);
}

}  // namespace

void drawModelSample(QPainter& painter, const QRectF& box, std::size_t model) {
    const ViewTransform unused;
    const Theme theme;
    const FieldCanvas canvas{painter, unused, theme};
    canvas.casedLine({box.left() + inset, box.center().y()}, {box.right() - inset - box.height() + 4, box.center().y()},
                     modelPen(model, 1.4));
    drawRing(canvas, box, modelColour(model), 1.3);
}

bool hasSample(FieldLayer layer) {
    return layer != FieldLayer::grid && layer != FieldLayer::names && layer != FieldLayer::legend;
}

void drawSample(QPainter& painter, const QRectF& box, FieldLayer layer, const Theme& theme) {
    painter.save();
    painter.setRenderHint(QPainter::Antialiasing);
    const ViewTransform unused;
    const FieldCanvas canvas{painter, unused, theme};
    const QColor colour = robotColour(4), neutral = theme.quietText;
    switch (layer) {
        case FieldLayer::headings:
            canvas.arrow(across(box).front(), across(box).back(), QColor(255, 255, 255), 3);
            break;
        case FieldLayer::trails:
            canvas.casedLine(across(box), roundPen(colour, 1.8));
            break;
        case FieldLayer::targets:
            canvas.casedLine(across(box), roundPen(colour, 1.5, Qt::DotLine));
            canvas.target(across(box).back() - QPointF(5, 0), colour, 1.4);
            break;
        case FieldLayer::sensors:
            painter.setPen(Qt::NoPen);
            painter.setBrush(withAlpha(colour, 110));
            drawSector(painter, box);
            break;
        case FieldLayer::readings:
            drawReadingSample(canvas, box, colour);
            break;
        case FieldLayer::laser:
            drawLaserSample(canvas, box, colour);
            break;
        case FieldLayer::sonar:
            drawEcho(painter, circleIn(box), -sampleHalf, 2 * sampleHalf, colour);
            break;
        case FieldLayer::infrared:
            painter.setPen(Qt::NoPen);
            painter.setBrush(withAlpha(colour, 60));
            drawSector(painter, box);
            painter.setBrush(withAlpha(colour, 200));
            drawSector(painter, box, 0.6);
            break;
        case FieldLayer::bumpers:
            drawBumperSample(canvas, box);
            break;
        case FieldLayer::lineCameras:
            drawRowSample(canvas, box);
            break;
        case FieldLayer::radio:
            drawRadioSample(canvas, box, colour);
            break;
        case FieldLayer::contacts:
            canvas.arrow(box.center(), across(box).front(), theme.contact, 3);
            canvas.arrow(box.center(), across(box).back(), theme.contact, 3);
            painter.setPen(roundPen(QColor(255, 255, 255), 1.2));
            painter.drawEllipse(box.center(), 3.5, 3.5);
            break;
        case FieldLayer::predicted:
            drawPath(canvas, box, theme.dark ? QColor(255, 255, 255) : neutral);
            break;
        case FieldLayer::uncertainty:
            drawBandSample(painter, box, colour);
            break;
        case FieldLayer::beliefs:
            drawOutlineSample(canvas, box, colour, false);
            break;
        case FieldLayer::ghosts:
            drawOutlineSample(canvas, box, neutral, true);
            break;
        case FieldLayer::reality:
            drawRealSample(canvas, box, colour);
            break;
        case FieldLayer::models:
            drawModelSample(painter, box, 0);
            break;
        default:
            break;
    }
    painter.restore();
}

}  // namespace mrose
