#include <QObject>
#include <QStringList>
#include <cmath>
#include <numbers>

#include "widgets/field_drawing.h"
#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"
#include "widgets/real_readout.h"

namespace mrose {
namespace {

constexpr double leastReadingGap = 4;  // a shorter one is below the mark

struct DrawnLook {
    const SensorLook& look;
    QColor colour;
    bool real;
    bool strong;  ///< the eye is on its robot
};

/// Those whose place is known: real ones last, above the others; those of the robot that the eye is on above all.
template <class Draw>
void drawEachLook(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
                  const std::vector<RobotLooks>& looks, Draw draw) {
    for (const bool strong : {false, true})
        for (const bool real : {false, true})
            for (const RobotLooks& of : looks) {
                if ((looks.size() == 1 || focus.selected == of.robot) != strong || focus.isQuiet(of.robot)) continue;
                const std::size_t place = frame.scene().placeOf(of.robot);
                const QColor colour = real ? realColour(place, canvas.theme) : robotColour(place);
                for (const SensorLook& look : real ? of.real : of.simulated)
                    if (look.eye) draw(DrawnLook{look, colour, real, strong});
            }
}

/// From the rim of a mark on.
void drawReadingGap(const FieldCanvas& canvas, const QPointF& reported, const QPointF& truth, const QColor& colour) {
    const QPointF along = truth - reported;
    const double size = std::hypot(along.x(), along.y());
    if (size < leastReadingGap) return;
    canvas.casedLine(reported + readingRadius / size * along, truth, roundPen(colour, 1.8));
    const QPointF across = 3.5 / size * QPointF(-along.y(), along.x());
    canvas.casedLine(truth - across, truth + across, roundPen(colour, 1.8));
}

}  // namespace

std::vector<RobotLooks> shownLooks(const FieldFrame& frame, const FieldLayers& layers, const FieldFocus& focus) {
    std::vector<RobotLooks> looks;
    const bool all = layers.has(FieldLayer::readings), real = frame.reality && layers.has(FieldLayer::reality);
    const std::size_t robots = frame.state.robots.size();
    for (std::size_t robot = 0; robot < robots && (all || real); ++robot) {
        const bool shown = focus.selected == robot || (all && robots <= mostNames);
        if (!shown) continue;
        RobotLooks of{robot, simulatedLooks(frame, robot), {}};
        if (real) of.real = realLooks(frame, robot);
        looks.push_back(std::move(of));
    }
    return looks;
}

void drawRays(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
              const std::vector<RobotLooks>& looks) {
    drawEachLook(canvas, frame, focus, looks, [&](const DrawnLook& of) {
        QPen pen = roundPen(withAlpha(of.colour, of.strong ? 230 : 120), of.strong ? 1.4 : 1,
                            of.real ? Qt::CustomDashLine : Qt::SolidLine);
        if (of.real) pen.setDashPattern({5, 4});
        canvas.painter.setPen(pen);
        for (const ReportedSubject& subject : of.look.subjects)
            canvas.painter.drawLine(canvas.at(position(*of.look.eye)), canvas.at(of.look.reported(subject)));
    });
}

void drawReadings(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
                  const std::vector<RobotLooks>& looks) {
    drawEachLook(canvas, frame, focus, looks, [&](const DrawnLook& of) {
        for (const ReportedSubject& subject : of.look.subjects) {
            const QPointF at = canvas.at(of.look.reported(subject));
            if (subject.truth) drawReadingGap(canvas, at, canvas.at(*subject.truth), of.colour);
            drawReadingMark(canvas, at, of.colour, of.real);
        }
    });
}

QString readingReadout(const ViewTransform& view, const FieldFrame& frame, const std::vector<RobotLooks>& looks,
                       const QPointF& pixels) {
    QStringList lines;
    const auto add = [&](const QString& whose, const std::vector<SensorLook>& of) {
        for (const SensorLook& look : of)
            for (const ReportedSubject& subject : look.subjects) {
                if (!look.eye) continue;
                const QPointF off = view.toPixels(look.reported(subject)) - pixels;
                if (std::hypot(off.x(), off.y()) > readingRadius + 2) continue;
                lines += QObject::tr("%1 by the %2 of %3: %4 m, %5\u00b0, %6 s ago")
                             .arg(qtText(subject.name), qtText(look.sensor), whose, fixedText(subject.range, 2),
                                  fixedText(subject.bearing * 180 / std::numbers::pi, 1),
                                  fixedText(toSeconds(frame.now() - look.measured), 2));
            }
    };
    for (const RobotLooks& of : looks) {
        const QString name = qtText(frame.nameOf(of.robot));
        add(name, of.simulated);
        add(QObject::tr("%1 %2").arg(realWord(frame), name), of.real);
    }
    return lines.join('\n');
}

void drawReadingMark(const FieldCanvas& canvas, const QPointF& at, const QColor& colour, bool real, double radius) {
    QPainter& painter = canvas.painter;
    if (!real) {
        painter.setPen(roundPen(withAlpha(setOff(colour), 190), 1.1));
        painter.setBrush(colour);
        painter.drawEllipse(at, radius, radius);
        return;
    }
    painter.setBrush(Qt::NoBrush);
    for (const QPen& pen : {roundPen(withAlpha(setOff(colour), 190), 3.4), roundPen(colour, 1.6)}) {
        painter.setPen(pen);
        painter.drawEllipse(at, radius + 0.6, radius + 0.6);
    }
}

}  // namespace mrose
