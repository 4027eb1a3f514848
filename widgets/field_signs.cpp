#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "widgets/field_drawing.h"
#include "widgets/field_readout.h"

namespace mrose {
namespace {

// Labels are known by what they are of.
std::uint64_t labelKey(std::uint64_t kind, std::uint64_t first, std::uint64_t second) {
    return kind << 56 | (first & 0xffffff) << 28 | (second & 0xffffff);
}

/// Of 255: how strong the notes of others than the selected robot are; where none is selected, points, and lines.
constexpr int faintest = 70, faint = 190, lines = 230;
/// Of those of whom an answer is not.
constexpr int quiet = 30;

bool hasNumber(const ContactReport& contact) { return contact.impulse >= 0.05; }

/// Whose number is seen: of all that have one, or where an answer is about some bodies, of the strongest on them.
bool isNumbered(const FieldFrame& frame, const FieldFocus& focus, const ContactReport& contact) {
    if (focus.lit.empty()) return hasNumber(contact);
    const ContactReport* strongest = nullptr;
    for (const ContactReport& one : frame.lastTick.contacts) {
        const bool about = std::any_of(focus.lit.begin(), focus.lit.end(),
                                       [&](std::size_t body) { return body == one.bodyA || body == one.bodyB; });
        if (about && hasNumber(one) && (strongest == nullptr || one.impulse > strongest->impulse)) strongest = &one;
    }
    return strongest == &contact;
}

/// Pixels, of the object that lies there; 0: none does.
double objectAt(const FieldCanvas& canvas, const FieldFrame& frame, const Point& point) {
    double reach = 0;
    for (std::size_t body = frame.state.robots.size(); body < frame.scene().bodyCount(); ++body) {
        const double own = frame.scene().shapeOf(body).reach;
        if (distance(position(frame.poseOf(body)), point) < own) reach = std::max(reach, canvas.pixels(own));
    }
    return reach;
}

void drawNoteLine(const FieldCanvas& canvas, const QPolygonF& points, const QColor& colour, bool selected) {
    if (selected) return canvas.casedLine(points, roundPen(colour, 2, Qt::DotLine));
    QPen pen = roundPen(colour, 2.2);
    pen.setDashPattern({1.2, 2.2});
    canvas.painter.setPen(pen);
    canvas.painter.drawPolyline(points);
}

}  // namespace

void drawBeliefs(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus) {
    const bool few = frame.insights.size() <= mostNames;
    for (std::size_t robot = 0; robot < frame.insights.size(); ++robot) {
        const RobotInsight& insight = frame.insights[robot];
        if (!insight.observed || (!few && focus.selected != robot)) continue;
        const Observation& seen = insight.observation;
        const QColor colour = robotColour(frame.scene(), robot);
        if (seen.localised()) {
            const Shape& shape = frame.scene().shapeOf(robot);
            if (focus.selected == robot)
                canvas.outline(shape, seen.self(), roundPen(withAlpha(setOff(colour), 110), 2.6));
            canvas.outline(shape, seen.self(), roundPen(colour, 1.4, Qt::DashLine));
            canvas.casedLine(canvas.at(position(frame.poseOf(robot))), canvas.at(position(seen.self())),
                             roundPen(colour, 0.8, Qt::DashLine));
        }
        if (focus.selected != robot) continue;
        const Placement at(seen.self());
        const auto cross = [&](const SeenBody& body) {
            const QPointF p = canvas.at(at.place(body.position_B));
            for (const QPen& pen : {roundPen(setOff(colour), 3.6), roundPen(colour, 2)}) {
                canvas.painter.setPen(pen);
                canvas.painter.drawLine(p - QPointF(4, 4), p + QPointF(4, 4));
                canvas.painter.drawLine(p - QPointF(4, -4), p + QPointF(4, -4));
            }
        };
        for (const SeenBody& body : seen.robots()) cross(body);
        for (const SeenBody& body : seen.objects()) cross(body);
    }
}

void drawNotes(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
               std::vector<FieldLabel>& labels) {
    const bool few = frame.scene().bodyCount() <= mostNames;
    for (std::size_t robot = 0; robot < frame.insights.size(); ++robot) {
        const bool selected = focus.selected == robot;
        if (!few && !selected) continue;
        const int alpha = selected ? 240 : focus.isQuiet(robot) ? quiet : focus.selected ? faintest : faint;
        const QColor colour = withAlpha(robotColour(frame.scene(), robot), alpha);
        const std::vector<Annotation>& notes = frame.insights[robot].decision.annotations;
        for (std::size_t i = 0; i < notes.size(); ++i) {
            const Annotation& note = notes[i];
            if (note.kind == Annotation::Kind::line) {
                WayLine line;
                for (const Point& point : note.points) line.add(canvas.at(point));
                const QColor ofWay = focus.selected || focus.isQuiet(robot) ? colour : withAlpha(colour, lines);
                for (const QPolygonF& points : line.lines()) drawNoteLine(canvas, points, ofWay, selected);
            }
            if (note.kind != Annotation::Kind::point) continue;
            for (const Point& point : note.points) {
                const double covered = objectAt(canvas, frame, point);
                canvas.target(canvas.at(point), colour, selected ? 2 : 1.3, covered);
                if (!selected) continue;
                FieldLabel& label = labels.emplace_back();
                label.key = labelKey(2, robot, i);
                label.at = point;
                label.clearance = 8 + covered;
                label.text = noteText(frame, robot, note);
                label.colour = canvas.theme.onFloor;
                label.chip = robotColour(frame.scene(), robot);
                label.note = true;
            }
        }
    }
}

double impulsePixels(double impulse, double scale) {
    constexpr double half = 1.5;  // N s at which the arrow has half of its greatest length
    return std::clamp(0.6 * scale, 12.0, longestImpulse) * impulse / (impulse + half);
}

void drawContacts(const FieldCanvas& canvas, const FieldFrame& frame, const FieldFocus& focus,
                  std::vector<FieldLabel>& labels) {
    const bool few = frame.lastTick.contacts.size() <= mostNames;
    std::map<std::uint64_t, std::uint64_t> touches;
    canvas.painter.setRenderHint(QPainter::Antialiasing, frame.lastTick.contacts.size() <= mostSmooth);
    for (const ContactReport& contact : frame.lastTick.contacts) {
        if (!canvas.visible(contact.position, 0.5)) continue;
        const QPointF at = canvas.at(contact.position), along(contact.normal.x, -contact.normal.y);
        const double size = impulsePixels(contact.impulse, canvas.view.scale());
        // Each of the two is pushed away from the other.
        for (const double way : {1.0, -1.0})
            if (size >= 5) canvas.arrow(at, at + way * size * along, canvas.theme.contact, 3);
        canvas.painter.setPen(few ? roundPen(QColor(255, 255, 255), 1.2) : hairline(QColor(255, 255, 255)));
        canvas.painter.setBrush(canvas.theme.contact);
        canvas.painter.drawEllipse(at, 3.5, 3.5);
        // Two bodies may touch at several places, each of which keeps its own number beside it.
        const std::uint64_t pair =
            labelKey(3, contact.bodyA, contact.bodyB == noBody ? ~contact.obstacle : contact.bodyB);
        const std::uint64_t which = touches[pair]++;
        if (!few || !isNumbered(frame, focus, contact)) continue;
        FieldLabel& label = labels.emplace_back();
        label.key = pair | (which & 0xf) << 24;
        label.at = contact.position;
        label.clearance = 8;
        label.text = impulseText(contact.impulse);
        label.colour = canvas.theme.onFloor;
    }
    canvas.painter.setRenderHint(QPainter::Antialiasing);
}

void drawKicks(const FieldCanvas& canvas, const FieldFrame& frame, std::vector<FieldLabel>& labels) {
    for (const StepTrace::Kicked& kick : frame.kicks) {
        const std::vector<Manipulator>& manipulators = frame.scene().typeOf(kick.robot).manipulators;
        if (kick.manipulator >= manipulators.size()) continue;
        const Manipulator& manipulator = manipulators[kick.manipulator];
        const Placement face(frame.poseOf(kick.robot) *
                             Pose{manipulator.position.x, manipulator.position.y, manipulator.direction});
        const QPointF from = canvas.at(face.origin), towards = canvas.at(face.place({1, 0})) - from;
        const double size = std::hypot(towards.x(), towards.y());
        const double shown = std::clamp(0.35 * size, 18.0, 60.0);
        const QColor colour = canvas.theme.kick;
        canvas.arrow(from, from + shown / size * towards, kick.hit ? colour : withAlpha(colour, 110), 4);
        FieldLabel& label = labels.emplace_back();
        label.key = labelKey(4, kick.robot, kick.manipulator);
        // Beside the robot that kicks, and in its colour: another may stand where the arrow ends.
        label.at = face.origin;
        label.clearance = 6;
        label.chip = robotColour(frame.scene(), kick.robot);
        label.first = true;
        label.text =
            kick.hit ? QObject::tr("kick, %1 m/s").arg(length(kick.speed_W), 0, 'f', 2) : QObject::tr("kick, missed");
        label.colour = canvas.theme.onFloor;
    }
}

}  // namespace mrose
