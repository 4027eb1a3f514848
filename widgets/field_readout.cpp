#include "widgets/field_readout.h"

#include <QObject>
#include <QStringList>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "debug/plotted_value.h"
#include "widgets/qt_text.h"

namespace mrose {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Without the sign of a zero that is none.
QString fixed(double value, int decimals) {
    const QString text = QString::number(value, 'f', decimals);
    return text.startsWith('-') && text.toDouble() == 0 ? text.mid(1) : text;
}

QString nameOfBody(const FieldFrame& frame, std::uint32_t body) {
    return body < frame.scene().bodyCount() ? qtText(frame.nameOf(body)) : QObject::tr("the place");
}

}  // namespace

QString lengthText(double metres) {
    if (std::abs(metres) < 0.9995) return fixed(100 * metres, std::abs(metres) < 0.0995 ? 1 : 0) + " cm";
    return fixed(metres, std::abs(metres) < 9.995 ? 2 : 1) + " m";
}

QString poseText(const Pose& pose) {
    return QObject::tr("x %1 m   y %2 m   %3%4")
        .arg(fixed(pose.x, 2), fixed(pose.y, 2), fixed(wrapAngle(pose.heading) / degree, 1),
             QString::fromUtf8("\u00b0"));
}

QString poseText(const FieldFrame& frame, std::size_t body, const Pose& pose) {
    const std::vector<ConvexPiece>& pieces = frame.scene().shapeOf(body).pieces;
    const bool round = pieces.size() == 1 && pieces[0].isCircle() && length(pieces[0].centre) < 1e-9;
    if (body < frame.state.robots.size() || !round) return poseText(pose);
    return QObject::tr("x %1 m   y %2 m").arg(fixed(pose.x, 2), fixed(pose.y, 2));
}

QString impulseText(double impulse) { return fixed(impulse, impulse < 9.995 ? 2 : 1) + " N s"; }

QString bodyReadout(const FieldFrame& frame, std::size_t body) {
    const Scene& scene = frame.scene();
    const std::size_t robots = scene.robots.size();
    const std::string& kind = body < robots ? scene.typeOf(body).name : scene.typeOfObject(body - robots).name;
    const QString name = qtText(frame.nameOf(body));
    QString text = qtText(kind) == name || kind.empty() ? name : name + QString::fromUtf8("  \u00b7  ") + qtText(kind);
    text += '\n' + poseText(frame, body, frame.poseOf(body)) + '\n';
    if (body >= robots) {
        const Twist& velocity = frame.state.objects[body - robots].velocity_W;
        return text + QObject::tr("%1 m/s").arg(fixed(std::hypot(velocity.x, velocity.y), 2));
    }
    const Twist& velocity = frame.state.robots[body].velocity_B;
    text += QObject::tr("%1 m/s ahead, %2%3/s")
                .arg(fixed(velocity.x, 2), fixed(velocity.rotation / degree, 1), QString::fromUtf8("\u00b0"));
    if (std::abs(velocity.y) >= 0.005) text += QObject::tr(", %1 m/s to the left").arg(fixed(velocity.y, 2));
    return text;
}

QString signReadout(const FieldFrame& frame, const Point& at, double reach) {
    QStringList lines;
    for (const ContactReport& contact : frame.lastTick.contacts)
        if (distance(contact.position, at) <= reach)
            lines += QObject::tr("%1 on %2: %3")
                         .arg(nameOfBody(frame, contact.bodyA), nameOfBody(frame, contact.bodyB),
                              impulseText(contact.impulse));
    for (std::size_t robot = 0; robot < frame.insights.size(); ++robot)
        for (const Annotation& note : frame.insights[robot].decision.annotations)
            if (note.kind == Annotation::Kind::point)
                for (const Point& point : note.points)
                    if (distance(point, at) <= reach)
                        lines += QObject::tr("%1: %2, x %3 m   y %4 m")
                                     .arg(nameOfBody(frame, static_cast<std::uint32_t>(robot)), qtText(note.label),
                                          fixed(point.x, 2), fixed(point.y, 2));
    return lines.join('\n');
}

QString kindAndSize(const SentMessage& message) {
    return QObject::tr("kind %1, %2 B").arg(message.kind).arg(message.size);
}

QString millisecondsText(Nanoseconds time) { return QObject::tr("%1 ms").arg(fixed(toSeconds(time) * 1e3, 0)); }

QString messageText(const FieldFrame& frame, const RadioLog::Entry& entry) {
    const Scene& scene = frame.scene();
    const auto outcome = [&] {
        switch (entry.transmission.outcome) {
            case Transmission::Outcome::lost:
                return QObject::tr("lost");
            case Transmission::Outcome::outOfRange:
                return QObject::tr("out of range");
            case Transmission::Outcome::received:
                break;
        }
        return millisecondsText(scene.timeOf(entry.tick) - scene.timeOf(entry.message.tick));
    };
    return QString("%1, %2").arg(kindAndSize(entry.message), outcome());
}

QString noteText(const FieldFrame& frame, std::size_t robot, const Annotation& note) {
    const QString label = qtText(note.label);
    return bodyNamed(frame.scene(), note.label) == noBody
               ? label
               : QObject::tr("%1\u2019s %2").arg(qtText(frame.nameOf(robot)), label);
}

}  // namespace mrose
