#include "widgets/inspector_rows.h"

#include <cmath>
#include <numbers>

#include "widgets/command_queue.h"
#include "widgets/timeline_bar.h"

namespace mrose {
namespace {

using Rows = std::vector<InspectorSection::Row>;

QString number(double value, int decimals, const char* unit) {
    // No "-0.00": it would flicker.
    const double rounding = 0.5 * std::pow(10, -decimals);
    return QString::number(std::abs(value) < rounding ? 0.0 : value, 'f', decimals) + ' ' + unit;
}

QString degrees(double radians) {
    return number(wrapAngle(radians) * 180 / std::numbers::pi, 1, "\u00b0").replace(" \u00b0", "\u00b0");
}

QString placeText(const Point& point) { return number(point.x, 3, "m").remove(" m") + ", " + number(point.y, 3, "m"); }
QString poseText(const Pose& pose) { return placeText({pose.x, pose.y}) + ", " + degrees(pose.heading); }
QString motionText(double v, double w) { return number(v, 3, "m/s") + ", " + number(w, 3, "rad/s"); }

/// How far apart, in the frame of the first: what was off, ahead and to the left.
QString offText(const Pose& from, const Pose& to) {
    const Pose off = relative(from, to);
    return number(100 * off.x, 1, "cm ahead") + ", " + number(100 * off.y, 1, "cm left") + ", " + degrees(off.heading);
}

InspectorSection whereabouts(const FieldFrame& frame, std::size_t body) {
    InspectorSection section{QObject::tr("Now"), {}};
    section.rows.push_back({QObject::tr("Pose"), poseText(frame.poseOf(body)), QObject::tr("x, y, heading in the world")});
    if (body < frame.state.robots.size()) {
        const Twist& v = frame.state.robots[body].velocity_B;
        section.rows.push_back({QObject::tr("Velocity"), motionText(v.x, v.rotation), QObject::tr("forward, turning")});
        section.rows.push_back({QObject::tr("Sideways"), number(v.y, 3, "m/s"), QObject::tr("to the left")});
    } else {
        const ObjectState& object = frame.state.objects[body - frame.state.robots.size()];
        section.rows.push_back(
            {QObject::tr("Speed"), number(std::hypot(object.velocity_W.x, object.velocity_W.y), 3, "m/s"), {}});
        section.rows.push_back({QObject::tr("Direction"), degrees(std::atan2(object.velocity_W.y, object.velocity_W.x)), {}});
        if (frame.scene().typeOfObject(body - frame.state.robots.size()).rolls)
            section.rows.push_back({QObject::tr("Slip"),
                                    number(length(Point{object.velocity_W.x, object.velocity_W.y} - object.roll_W), 3, "m/s"),
                                    QObject::tr("speed of its lowest point over the floor: 0 where it rolls")});
    }
    return section;
}

InspectorSection commands(const FieldFrame& frame, std::size_t robot) {
    const CommandView view = frame.scenario->commandsOf(frame.state, robot);
    CommandQueue::Content content{{}, view.beforeFirst(), frame.scene().timeOf(frame.state.tick),
                                  frame.scene().modelOf(robot).deadTimes()};
    for (std::size_t i = 0; i < view.size(); ++i) content.commands.push_back({view.issueTime(i), view.command(i)});
    const CommandsOnTheWay way = commandsOnTheWay(content);
    InspectorSection section{QObject::tr("Commands"), {}};
    section.rows.push_back({QObject::tr("In effect"), motionText(way.active.v, way.active.w),
                            QObject::tr("issued a dead time ago")});
    const Command last = view.at(content.now);
    section.rows.push_back({QObject::tr("Issued last"), motionText(last.v, last.w), {}});
    section.rows.push_back({QObject::tr("Dead time"), number(toSeconds(content.deadTimes.v) * 1e3, 0, "ms") + ", " +
                                                          number(toSeconds(content.deadTimes.w) * 1e3, 0, "ms"),
                            QObject::tr("of forward speed, of rotation")});
    const std::vector<Manipulator>& manipulators = frame.scene().typeOf(robot).manipulators;
    for (std::size_t m = 0; m < manipulators.size(); ++m) {
        const Nanoseconds wait = frame.state.robots[robot].ready[m] - content.now;
        section.rows.push_back({QString::fromStdString(manipulators[m].name),
                                wait <= 0 ? QObject::tr("ready") : number(toSeconds(wait), 2, "s until ready"), {}});
    }
    return section;
}

InspectorSection motion(const FieldFrame& frame, std::size_t robot) {
    InspectorSection section{QObject::tr("Motion model"), {}};
    const MotionSegment& segment = frame.state.robots[robot].segment;
    const Pose end = segment.start * segment.increment;
    section.rows.push_back({QObject::tr("Predicted"), poseText(end), QObject::tr("where it will be at its next control instant")});
    section.rows.push_back({QObject::tr("with velocity"), motionText(segment.endVelocity.v, segment.endVelocity.w), {}});
    if (robot < frame.lastTick.size()) {
        const StepTrace::Robot& told = frame.lastTick[robot];
        section.rows.push_back({QObject::tr("Contact"),
                                told.touched ? offText(told.planned, frame.poseOf(robot)) : QObject::tr("none"),
                                QObject::tr("what it changed in the last tick, beside the planned way"), told.touched});
    }
    section.rows.push_back({QObject::tr("On its way"), frame.state.robots[robot].pushed
                                                           ? QObject::tr("pushed off, wheels recover")
                                                           : QObject::tr("yes"),
                            {}, frame.state.robots[robot].pushed});
    return section;
}

void seenRows(const FieldFrame& frame, const RobotInsight& insight, bool robots, Rows& rows) {
    const std::vector<SeenBody>& seen = robots ? insight.observation.robots : insight.observation.objects;
    for (const SeenBody& body : seen) {
        const std::size_t index = robots ? body.index : frame.state.robots.size() + body.index;
        const Point believed = Placement(insight.observation.self).place(body.position_B);
        const double off = length(believed - position(frame.poseOf(index)));
        rows.push_back({QString::fromStdString(frame.nameOf(index)),
                        placeText(believed) + QObject::tr(", off by ") + number(100 * off, 0, "cm"),
                        QObject::tr("where it thinks this is, and how far from where it is now")});
    }
}

InspectorSection perception(const FieldFrame& frame, std::size_t robot) {
    InspectorSection section{QObject::tr("Sees"), {}};
    const RobotInsight& insight = frame.insights[robot];
    if (!insight.observed) return section;
    const Observation& seen = insight.observation;
    const Nanoseconds now = frame.scene().timeOf(frame.state.tick);
    section.rows.push_back({QObject::tr("Itself"), seen.localised ? poseText(seen.self) : QObject::tr("not yet"), {}});
    if (seen.localised) {
        section.rows.push_back({QObject::tr("off by"), offText(frame.poseOf(robot), seen.self), {}});
        section.rows.push_back({QObject::tr("measured"), number(toSeconds(now - seen.selfMeasured) * 1e3, 0, "ms ago"), {}});
    }
    seenRows(frame, insight, false, section.rows);
    seenRows(frame, insight, true, section.rows);
    return section;
}

InspectorSection controller(const FieldFrame& frame, std::size_t robot) {
    InspectorSection section{QObject::tr("Controller"), {}};
    const RobotInsight& insight = frame.insights[robot];
    if (insight.tick < 0) {
        section.rows.push_back({QObject::tr("Decided"), QObject::tr("not yet"), {}});
        return section;
    }
    const Decision& decision = insight.decision;
    section.rows.push_back({QObject::tr("Decided"), clockText(frame.scene().timeOf(insight.tick)), {}});
    section.rows.push_back({QObject::tr("Command"), decision.command ? motionText(decision.command->v, decision.command->w)
                                                                     : QObject::tr("goes on"),
                            {}});
    for (const Kick& kick : decision.kicks)
        section.rows.push_back({QObject::tr("Kick"), number(100 * kick.power, 0, "% of power"), {}, true});
    for (const Annotation& note : decision.annotations) {
        QString value;
        if (note.kind == Annotation::Kind::value) value = QString::number(note.value, 'f', 3);
        if (note.kind == Annotation::Kind::text) value = QString::fromStdString(note.text);
        if (note.kind == Annotation::Kind::point && !note.points.empty()) value = placeText(note.points.front());
        if (note.kind == Annotation::Kind::line && !note.points.empty())
            value = placeText(note.points.front()) + " \u2192 " + placeText(note.points.back());
        section.rows.push_back({QString::fromStdString(note.label), value, QObject::tr("the controller's own note")});
    }
    if (!decision.breakReason.empty())
        section.rows.push_back({QObject::tr("Stop"), QString::fromStdString(decision.breakReason), {}, true});
    if (!decision.fault.empty())
        section.rows.push_back({QObject::tr("Failed"), QString::fromStdString(decision.fault), {}, true});
    const std::size_t memory = frame.scenario->memoryOf(frame.state, robot).size();
    if (memory > 0) section.rows.push_back({QObject::tr("Memory"), QObject::tr("%1 bytes").arg(memory), {}});
    return section;
}

}  // namespace

std::vector<InspectorSection> inspectorSections(const FieldFrame& frame, std::size_t body) {
    std::vector<InspectorSection> sections{whereabouts(frame, body)};
    if (body >= frame.state.robots.size()) return sections;
    sections.push_back(commands(frame, body));
    sections.push_back(motion(frame, body));
    sections.push_back(controller(frame, body));
    if (InspectorSection seen = perception(frame, body); !seen.rows.empty()) sections.push_back(std::move(seen));
    return sections;
}

}  // namespace mrose
