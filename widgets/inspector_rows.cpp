#include "widgets/inspector_rows.h"

#include <cmath>

#include "debug/real_robot.h"
#include "diagnosis/other_models.h"
#include "widgets/command_queue.h"
#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"

namespace mrose {
namespace {

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

QString commandCount(int count) {
    return count == 1 ? QObject::tr("1 command") : QObject::tr("%1 commands").arg(count);
}

InspectorRow commandRows(const RowWriter& write) {
    InspectorRow section = write.section("Commands");
    auto& rows = section.children;
    const DeadTimeQueue queue = deadTimeQueueOf(*write.frame.scenario, write.frame.state, write.body);
    const CommandsOnTheWay way = commandsOnTheWay(queue);
    const auto waiting = static_cast<int>(way.coming.size());
    InspectorRow coming = RowWriter::text(
        QObject::tr("Not active yet"), waiting == 0 ? QObject::tr("none") : commandCount(waiting),
        QObject::tr(
            "commands that were issued and wait for their dead time; only those that differ from the one before"));
    coming.quiet = waiting == 0;
    for (const CommandsOnTheWay::Coming& one : way.coming) coming.children.push_back(comingCommand(one));
    rows.push_back(std::move(coming));
    const auto deadTime = [&](const QString& name, Nanoseconds time) {
        InspectorRow row = RowWriter::text(name, fixedText(toSeconds(time), 3),
                                           QObject::tr("from a command's issue to its effect, as identified"));
        row.unit = "s";
        rows.push_back(std::move(row));
    };
    deadTime(QObject::tr("Delay, forward"), queue.deadTimes.v);
    deadTime(QObject::tr("Delay, turning"), queue.deadTimes.w);
    return section;
}

/// With what power a kick is on its way.
InspectorRow kickRows(const RowWriter& write) {
    InspectorRow section = write.section("Kicks");
    const std::vector<Manipulator>& manipulators = write.frame.scene().typeOf(write.body).manipulators;
    for (InspectorRow& row : section.children)
        for (const PendingKick& kick : write.frame.state.kicks) {
            const bool due = kick.robot == write.body && row.plot->quantity == "kick_in" &&
                             row.plot->of == manipulators[kick.manipulator].name;
            if (!due) continue;
            row.notable = true;
            row.tip += QObject::tr("; with %1 % of its power").arg(fixedText(100 * kick.power, 0));
        }
    return section;
}

/// In the colour of contacts, unless it is too small for the digits that are shown.
void setNotable(InspectorRow& row, bool touched) {
    row.notable = touched && row.value.toDouble() != 0;
    row.quiet = !row.notable;
}

/// How a body came to be where it is not planned to be.
InspectorRow contactRow(const RowWriter& write) {
    std::vector<std::uint32_t> others;
    for (const ContactReport& contact : write.frame.lastTick.contacts) {
        const bool first = contact.bodyA == write.body;
        if (!first && contact.bodyB != write.body) continue;
        const std::uint32_t other = first ? contact.bodyB : contact.bodyA;
        if (std::find(others.begin(), others.end(), other) == others.end()) others.push_back(other);
    }
    InspectorRow all = write.value(quantityNamed("impulse", Quantity::Of::body));
    setNotable(all, !others.empty());
    all.open = true;
    for (const std::uint32_t other : others) {
        InspectorRow row = write.value(quantityNamed("impulse", Quantity::Of::touchingPair), other);
        row.name = QObject::tr("with %1").arg(qtText(row.plot->of));
        setNotable(row, true);
        all.children.push_back(std::move(row));
    }
    return all;
}

/// The row is there only where the network says where it was learned.
void markUnfamiliar(const RowWriter& write, InspectorRow& section) {
    const Quantity& quantity = quantityNamed("unfamiliar", Quantity::Of::robot);
    const double value = numberOf(quantity.value({write.at, write.body}));
    for (InspectorRow& row : section.children)
        if (row.plot->quantity == quantity.name) row.notable = value > FamiliarDriving::bound;
}

InspectorRow predictionRows(const RowWriter& write) {
    InspectorRow section = write.section("Motion model");
    const std::vector<StepTrace::Robot>& robots = write.frame.lastTick.robots;
    const bool touched = write.body < robots.size() && robots[write.body].touched;
    for (InspectorRow& row : section.children)
        if (row.plot->quantity.starts_with("pushed")) setNotable(row, touched);
    markUnfamiliar(write, section);
    section.children.push_back(contactRow(write));
    return section;
}

InspectorRow lostRow(const std::optional<RealRobot>& robot, const char* real) {
    InspectorRow row = RowWriter::text(
        QObject::tr("Ground truth"),
        robot ? QObject::tr("none for %1 s").arg(toSeconds(*robot->lostFor), 0, 'f', 1) : QObject::tr("none yet"),
        QObject::tr("the log does not say where the %1 robot is").arg(real));
    row.notable = true;
    return row;
}

/// How far the robot, or a motion model in its place, is from the real one. nullopt: no real robot drove what this one
/// repeats.
std::optional<InspectorRow> realityRows(const RowWriter& write) {
    const FieldFrame& frame = write.frame;
    if (frame.reality == nullptr || frame.reality->robotNamed(frame.nameOf(write.body)) == nullptr) return std::nullopt;
    InspectorRow section = write.section("Reality");
    if (const auto robot = realRobotOf(frame, write.body); !robot || !robot->known())
        section.children.insert(section.children.begin(), lostRow(robot, realWord(frame)));
    for (const Reality::ModelRollout& model : frame.reality->models) {
        const auto error = [&](const char* quantity) {
            return write.item(quantityNamed(quantity, Quantity::Of::items), {model.name, ""});
        };
        InspectorRow row = error(modelPositionErrorQuantity);
        row.name = qtText(briefName(model.name));
        row.children.push_back(error(modelHeadingErrorQuantity));
        row.children.back().name = headingErrorQuantity;
        section.children.push_back(std::move(row));
    }
    return section;
}

InspectorRow touchRows(const RowWriter& write) {
    InspectorRow section = RowWriter::section(QObject::tr("Touched by"));
    section.children.push_back(contactRow(write));
    return section;
}

}  // namespace

RowWriter::RowWriter(const FieldFrame& shown, std::size_t which)
    : frame(shown), body(static_cast<std::uint32_t>(which)), at(shown.moment()) {}

InspectorRow RowWriter::value(const BoundValue& value, const QString& name) const {
    const ValueKey key = keyOf(*at.scenario, value);
    InspectorRow row;
    row.id = qtText(key.quantity + ' ' + key.of);
    row.name = name;
    const QuantityValue content = value.value(at);
    row.tip =
        QObject::tr("%1\n%2 in conditions").arg(QObject::tr(value.quantity->what), qtText(pathOf(*at.scenario, value)));
    if (const auto* const text = std::get_if<std::string>(&content)) {
        row.value = qtText(*text);
        return row;
    }
    row.plot = key;
    if (const bool* const truth = std::get_if<bool>(&content)) {
        row.value = *truth ? QObject::tr("yes") : QObject::tr("no");
        row.notable = *truth;
        row.quiet = !*truth;
        return row;
    }
    const double number = value.shown(numberOf(content));
    const QString unit = qtText(value.shownUnit());
    // Of what has a name of its own and no unit, whole numbers are counts.
    const bool count = !value.item.empty() && unit.isEmpty() && number == std::round(number);
    row.value = fixedText(number, count ? 0 : value.quantity->unit.digits);
    row.quiet = !std::isfinite(number);
    if (!row.quiet) row.unit = unit;
    return row;
}

InspectorRow RowWriter::value(const Quantity& quantity, std::uint32_t other) const {
    return value({&quantity, body, other}, quantity.name);
}

InspectorRow RowWriter::item(const Quantity& quantity, const Quantity::Item& item) const {
    return value({&quantity, body, noBody, item.name, item.unit}, qtText(item.name));
}

InspectorRow RowWriter::section(const char* name) const {
    InspectorRow section = RowWriter::section(QObject::tr(name));
    for (const Quantity& quantity : quantities()) {
        if (quantity.section != std::string_view(name) || !hasQuantity(frame.scene(), body, quantity)) continue;
        if (quantity.of != Quantity::Of::items) {
            section.children.push_back(value(quantity));
            continue;
        }
        for (const Quantity::Item& one : quantity.items({at, body})) {
            section.children.push_back(item(quantity, one));
            section.children.back().name = QString("%1 %2").arg(quantity.name, qtText(one.name));
        }
    }
    return section;
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
    std::vector<InspectorRow> rows{write.section("Motion")};
    if (body >= frame.state.robots.size()) {
        rows.push_back(touchRows(write));
        return rows;
    }
    if (auto reality = realityRows(write)) rows.push_back(std::move(*reality));
    rows.push_back(commandRows(write));
    if (!frame.scene().typeOf(body).manipulators.empty()) rows.push_back(kickRows(write));
    rows.push_back(predictionRows(write));
    rows.push_back(controllerRows(write));
    if (auto readings = readingRows(write, isOpen)) rows.push_back(std::move(*readings));
    rows.push_back(radioRows(write));
    rows.push_back(perceptionRows(write));
    rows.push_back(memoryRows(write, isOpen));
    return rows;
}

}  // namespace mrose
