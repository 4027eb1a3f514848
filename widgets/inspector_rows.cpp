#include "widgets/inspector_rows.h"

#include <cmath>

#include "widgets/command_queue.h"
#include "widgets/real_robots.h"
#include "widgets/timeline_bar.h"

namespace mrose {
namespace {

InspectorRow motionRows(const RowWriter& write) {
    InspectorRow section = RowWriter::section(QObject::tr("Motion"));
    const bool robot = write.body < write.frame.state.robots.size();
    const auto add = [&](const QString& name, const char* quantity, const QString& tip) {
        section.children.push_back(write.number(name, quantity, tip));
    };
    add(QObject::tr("x"), "x", QObject::tr("of the reference point, in the world"));
    add(QObject::tr("y"), "y", QObject::tr("of the reference point, in the world"));
    add(QObject::tr("Heading"), "heading", QObject::tr("counter-clockwise from the x axis"));
    add(QObject::tr("Speed"), "speed", QObject::tr("in whatever direction"));
    if (robot) {
        add(QObject::tr("Forward"), "forward", QObject::tr("its velocity along its heading"));
        add(QObject::tr("Sideways"), "sideways", QObject::tr("its velocity to its left: where it is pushed"));
        add(QObject::tr("Turning"), "turning", QObject::tr("counter-clockwise"));
        return section;
    }
    add(QObject::tr("Direction"), "direction", QObject::tr("in which it moves"));
    add(QObject::tr("Spin"), "spin", QObject::tr("about the vertical"));
    if (write.frame.scene().typeOfObject(write.body - write.frame.state.robots.size()).rolls)
        add(QObject::tr("Slip"), "slip", QObject::tr("speed of its lowest point over the floor: 0 where it rolls"));
    return section;
}

InspectorRow comingCommand(const CommandsOnTheWay::Coming& coming) {
    const auto wait = [](Nanoseconds until) {
        return until == 0 ? QObject::tr("now") : QObject::tr("in %1 ms").arg(fixedText(toSeconds(until) * 1e3, 0));
    };
    InspectorRow row = RowWriter::text(
        clockText(coming.issued.time),
        QString("%1 m/s, %2 rad/s").arg(fixedText(coming.issued.command.v, 2), fixedText(coming.issued.command.w, 2)),
        QObject::tr("forward speed takes effect %1, rotation %2").arg(wait(coming.untilV), wait(coming.untilW)));
    row.id = QString::number(coming.issued.time);
    return row;
}

InspectorRow commandRows(const RowWriter& write) {
    InspectorRow section = RowWriter::section(QObject::tr("Commands"));
    auto& rows = section.children;
    const QString active = QObject::tr("issued a dead time ago: what it does now");
    rows.push_back(write.number(QObject::tr("In effect, forward"), "forward in effect", active));
    rows.push_back(write.number(QObject::tr("In effect, turning"), "turning in effect", active));
    const QString last = QObject::tr("takes effect a dead time from its issue");
    rows.push_back(write.number(QObject::tr("Issued, forward"), "commanded forward", last));
    rows.push_back(write.number(QObject::tr("Issued, turning"), "commanded turning", last));
    const CommandQueue::Content content = commandsOf(*write.frame.scenario, write.frame.state, write.body);
    const CommandsOnTheWay way = commandsOnTheWay(content);
    InspectorRow coming = RowWriter::text(QObject::tr("On their way"), QString::number(way.coming.size()),
                                          QObject::tr("commands that differ from the one before"));
    for (const CommandsOnTheWay::Coming& one : way.coming) coming.children.push_back(comingCommand(one));
    rows.push_back(std::move(coming));
    const auto deadTime = [&](const QString& name, Nanoseconds time) {
        InspectorRow row = RowWriter::text(name, fixedText(toSeconds(time), 3),
                                           QObject::tr("from a command's issue to its effect, as identified"));
        row.unit = "s";
        rows.push_back(std::move(row));
    };
    deadTime(QObject::tr("Delay, forward"), content.deadTimes.v);
    deadTime(QObject::tr("Delay, turning"), content.deadTimes.w);
    return section;
}

InspectorRow kickRows(const RowWriter& write) {
    InspectorRow section = RowWriter::section(QObject::tr("Kicks"));
    const std::vector<Manipulator>& manipulators = write.frame.scene().typeOf(write.body).manipulators;
    for (std::size_t m = 0; m < manipulators.size(); ++m) {
        const QString name = QString::fromStdString(manipulators[m].name);
        InspectorRow ready = write.number(QObject::tr("%1 ready in").arg(name), "ready in",
                                          QObject::tr("until it can act again"), manipulators[m].name);
        InspectorRow due =
            write.number(QObject::tr("%1 kicks in").arg(name), "kick due in",
                         QObject::tr("a kick on its way: until it is carried out"), manipulators[m].name);
        due.quiet = true;
        for (const PendingKick& kick : write.frame.state.kicks) {
            if (kick.robot != write.body || kick.manipulator != m) continue;
            due.quiet = false;
            due.notable = true;
            due.tip += QObject::tr("; with %1 % of its power").arg(fixedText(100 * kick.power, 0));
        }
        section.children.push_back(std::move(ready));
        section.children.push_back(std::move(due));
    }
    return section;
}

/// In the colour of contacts, unless it is too small for the digits that are shown.
void setNotable(InspectorRow& row, bool touched) {
    row.notable = touched && row.value.toDouble() != 0;
    row.quiet = !row.notable;
}

/// How a body came to be where it is not planned to be.
void contactRows(const RowWriter& write, std::vector<InspectorRow>& rows) {
    std::vector<std::uint32_t> others;
    for (const ContactReport& contact : write.frame.contacts) {
        const bool first = contact.bodyA == write.body;
        if (!first && contact.bodyB != write.body) continue;
        const std::uint32_t other = first ? contact.bodyB : contact.bodyA;
        if (std::find(others.begin(), others.end(), other) == others.end()) others.push_back(other);
    }
    InspectorRow all = write.number(QObject::tr("Contact"), "impulse", QObject::tr("of all touches in the last tick"));
    setNotable(all, !others.empty());
    all.open = true;
    for (const std::uint32_t other : others) {
        const std::string of = other == noBody ? wallName : write.frame.nameOf(other);
        InspectorRow row = write.number(QObject::tr("with %1").arg(QString::fromStdString(of)), "impulse from",
                                        QObject::tr("along the normal, in the last tick"), of);
        setNotable(row, true);
        all.children.push_back(std::move(row));
    }
    rows.push_back(std::move(all));
}

InspectorRow predictionRows(const RowWriter& write) {
    InspectorRow section = RowWriter::section(QObject::tr("Motion model"));
    auto& rows = section.children;
    const QString end = QObject::tr("predicted for the end of its control period, if nothing touches it");
    rows.push_back(write.number(QObject::tr("Predicted x"), "predicted x", end));
    rows.push_back(write.number(QObject::tr("Predicted y"), "predicted y", end));
    rows.push_back(write.number(QObject::tr("Predicted heading"), "predicted heading", end));
    rows.push_back(write.number(QObject::tr("Predicted forward"), "predicted forward", end));
    rows.push_back(write.number(QObject::tr("Predicted turning"), "predicted turning", end));
    contactRows(write, rows);
    const bool touched = write.body < write.frame.lastTick.size() && write.frame.lastTick[write.body].touched;
    const QString off =
        QObject::tr("where contact put it in the last tick, as seen from where the model had planned it");
    for (const auto& [name, quantity] : {std::pair{QObject::tr("Put ahead by"), "pushed ahead"},
                                         {QObject::tr("Put to the left by"), "pushed left"},
                                         {QObject::tr("Turned by"), "pushed round"}}) {
        rows.push_back(write.number(name, quantity, off));
        setNotable(rows.back(), touched);
    }
    const bool pushed = write.frame.state.robots[write.body].pushed;
    rows.push_back(RowWriter::text(QObject::tr("Wheels"),
                                   pushed ? QObject::tr("bring it back") : QObject::tr("follow the model"),
                                   QObject::tr("a pushed robot returns to its way as fast as traction allows")));
    rows.back().notable = pushed;
    rows.back().plot = ValueKey{"recovers", write.bodyName};
    return section;
}

InspectorRow lostRow(const std::optional<RealRobot>& robot) {
    InspectorRow row = RowWriter::text(
        QObject::tr("Ground truth"),
        robot ? QObject::tr("none for %1 s").arg(toSeconds(*robot->lostFor), 0, 'f', 1) : QObject::tr("none yet"),
        QObject::tr("the log does not say where the real robot is"));
    row.notable = true;
    return row;
}

/// How far the robot, or a motion model in its place, is from the real one.
InspectorRow modelRows(const RowWriter& write, const std::string& model) {
    const QString position = QObject::tr("of what this motion model makes of the same start and commands");
    InspectorRow row = write.number(QString::fromStdString(model), positionErrorQuantity, position, model);
    row.children.push_back(write.number(QObject::tr("Heading error"), headingErrorQuantity, position, model));
    return row;
}

/// Nothing: no real robot drove what this one repeats.
std::optional<InspectorRow> realityRows(const RowWriter& write) {
    const auto real = write.frame.reality == nullptr ? nullptr : write.frame.reality->robotNamed(write.bodyName);
    if (real == nullptr) return std::nullopt;
    InspectorRow section = RowWriter::section(QObject::tr("Reality"));
    const auto add = [&](const QString& name, const char* quantity, const QString& tip) {
        section.children.push_back(write.number(name, quantity, tip));
    };
    add(QObject::tr("Position error"), positionErrorQuantity, QObject::tr("from the real robot to the simulated one"));
    add(QObject::tr("Heading error"), headingErrorQuantity, QObject::tr("without its sign"));
    const QString frame = QObject::tr("where the simulated robot is, as seen from the real one");
    add(QObject::tr("Error ahead"), "error ahead", frame);
    add(QObject::tr("Error to the left"), "error to the left", frame);
    const QString truth = QObject::tr("by the log's ground truth");
    add(QObject::tr("Real x"), "real x", truth);
    add(QObject::tr("Real y"), "real y", truth);
    add(QObject::tr("Real heading"), "real heading", truth);
    add(QObject::tr("Real forward"), "real forward", QObject::tr("the slope of the ground truth, along its heading"));
    add(QObject::tr("Real turning"), "real turning", QObject::tr("the slope of the ground truth"));
    if (const auto robot = realRobotOf(write.frame, write.body); !robot || !robot->known())
        section.children.insert(section.children.begin(), lostRow(robot));
    for (const Reality::ModelCourse& model : write.frame.reality->models)
        section.children.push_back(modelRows(write, model.name));
    return section;
}

InspectorRow touchRows(const RowWriter& write) {
    InspectorRow section = RowWriter::section(QObject::tr("Touched by"));
    contactRows(write, section.children);
    return section;
}

}  // namespace

RowWriter::RowWriter(const FieldFrame& shown, std::size_t which)
    : frame(shown), body(which), at(momentOf(shown)), bodyName(shown.nameOf(which)) {}

InspectorRow RowWriter::number(const QString& name, const ValueKey& key, const QString& tip) const {
    const QuantityText* const text = quantityText(key.quantity);
    InspectorRow row;
    row.id = QString::fromStdString(key.quantity + ' ' + key.of);
    row.name = name;
    const double value = readValue(at, key, static_cast<std::uint32_t>(body));
    row.value = fixedText(value, text->decimals);
    row.unit = key.unit == "rad" ? QString::fromUtf8("\u00b0")
                                 : QString::fromUtf8(key.unit.empty() ? text->unit : key.unit.c_str());
    row.tip = tip;
    row.plot = key;
    row.quiet = !std::isfinite(value);
    return row;
}

InspectorRow RowWriter::number(const QString& label, const char* quantity, const QString& tip,
                               const std::string& of) const {
    return number(label, ValueKey{quantity, bodyName, of}, tip);
}

InspectorRow RowWriter::text(const QString& name, const QString& value, const QString& tip) {
    InspectorRow row;
    row.id = row.name = name;
    row.value = value;
    row.tip = tip;
    return row;
}

InspectorRow RowWriter::section(const QString& name, bool open) {
    InspectorRow row = text(name, {});
    row.open = open;
    return row;
}

std::vector<InspectorRow> inspectorRows(const FieldFrame& frame, std::size_t body, const RowIsOpen& isOpen) {
    const RowWriter write(frame, body);
    std::vector<InspectorRow> rows{motionRows(write)};
    if (body >= frame.state.robots.size()) {
        rows.push_back(touchRows(write));
        return rows;
    }
    if (auto reality = realityRows(write)) rows.push_back(std::move(*reality));
    rows.push_back(commandRows(write));
    if (InspectorRow kicks = kickRows(write); !kicks.children.empty()) rows.push_back(std::move(kicks));
    rows.push_back(predictionRows(write));
    rows.push_back(controllerRows(write));
    rows.push_back(perceptionRows(write));
    rows.push_back(memoryRows(write, isOpen));
    return rows;
}

}  // namespace mrose
