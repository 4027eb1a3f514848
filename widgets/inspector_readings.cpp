// What the sensors of a robot reported last, beside what those of the real one did.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "control/sensor_records.h"
#include "debug/sensor_looks.h"
#include "debug/sensor_scans.h"
#include "widgets/fixed_text.h"
#include "widgets/inspector_rows.h"
#include "widgets/qt_text.h"

namespace mrose {
namespace {

QString noValue() { return QString::fromUtf8("\u2013"); }

QString bearingText(double radians) { return fixedText(radians * 180 / std::numbers::pi, 1); }

/// What one sensor reported, in simulation and reality.
struct SensorRows {
    QString sensor;
    bool logged = false;  ///< the real robot has it
    std::vector<const SensorLook*> simulated, real;

    const ReportedSubject* in(const std::vector<const SensorLook*>& looks, const std::string& name) const {
        for (const SensorLook* look : looks)
            for (const ReportedSubject& subject : look->subjects)
                if (subject.name == name) return &subject;
        return nullptr;
    }
    /// Of all subjects, those of one kind together, by their numbers.
    std::vector<std::string> subjects() const {
        std::vector<std::string> names;
        for (const auto* looks : {&simulated, &real})
            for (const SensorLook* look : *looks)
                for (const ReportedSubject& subject : look->subjects) names.push_back(subject.name);
        std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
            const auto head = [](const std::string& name) { return name.substr(0, name.find_last_of(' ')); };
            if (head(a) != head(b)) return head(a) < head(b);
            return a.size() != b.size() ? a.size() < b.size() : a < b;
        });
        names.erase(std::unique(names.begin(), names.end()), names.end());
        return names;
    }
};

/// Of the sensors that the real robot's log has looks of, and of those that the simulated one has for itself.
std::vector<SensorRows> sensorRows(const RowWriter& write, const std::vector<SensorLook>& simulated,
                                   const std::vector<SensorLook>& real) {
    std::vector<SensorRows> all;
    const auto add = [&](const std::string& sensor, bool logged) {
        const QString name = qtText(sensor);
        if (std::any_of(all.begin(), all.end(), [&](const SensorRows& rows) { return rows.sensor == name; })) return;
        SensorRows& rows = all.emplace_back(SensorRows{name, logged, {}, {}});
        for (const SensorLook& look : simulated)
            if (look.sensor == sensor) rows.simulated.push_back(&look);
        for (const SensorLook& look : real)
            if (look.sensor == sensor) rows.real.push_back(&look);
    };
    for (const std::string& sensor : realLookers(write.frame, write.body)) add(sensor, true);
    for (const SensorPointer& sensor : write.frame.scene().typeOf(write.body).sensors)
        for (const ReadingKind& kind : sensor->gives())
            if (*kind.type == recordType<SeenBody>()) add(sensor->name(), false);
    return all;
}

QString ageText(const FieldFrame& frame, const std::vector<const SensorLook*>& looks) {
    if (looks.empty()) return noValue();
    return QObject::tr("%1 s").arg(fixedText(toSeconds(frame.now() - looks.front()->measured), 2));
}

/// Range and bearing, in the columns of a table.
QStringList readingCells(const ReportedSubject* reading) {
    if (reading == nullptr) return {noValue(), noValue()};
    return {fixedText(reading->range, 2), bearingText(reading->bearing)};
}

InspectorRow tableRow(const QString& name, const QStringList& cells, const QString& tip = {}) {
    InspectorRow row = RowWriter::text(name, {}, tip);
    row.cells = cells;
    return row;
}

/// Where it truly was when that was reported.
QString truthText(const std::vector<const SensorLook*>& looks, const std::string& name) {
    for (const SensorLook* look : looks)
        for (const ReportedSubject& subject : look->subjects) {
            if (subject.name != name || !subject.truth || !look->eye) continue;
            const Point at = Placement(*look->eye).rotateBack(*subject.truth - position(*look->eye));
            return QObject::tr("truly %1 m, %2\u00b0")
                .arg(fixedText(length(at), 2), bearingText(std::atan2(at.y, at.x)));
        }
    return QObject::tr("not reported, or not known where it truly was");
}

InspectorRow rowsOf(const RowWriter& write, const SensorRows& of) {
    InspectorRow table = RowWriter::section(of.sensor);
    auto& rows = table.children;
    rows.push_back(
        tableRow("", {"", of.logged ? QString(realWord(write.frame)) : QString(), "", QObject::tr("simulated")}));
    rows.push_back(
        tableRow(QObject::tr("age"),
                 {"", of.logged ? ageText(write.frame, of.real) : QString(), "", ageText(write.frame, of.simulated)},
                 QObject::tr("since what it reported last was measured")));
    const QString metres = "m", degrees = QString::fromUtf8("\u00b0");
    rows.push_back(tableRow(QObject::tr("subject"),
                            {of.logged ? metres : QString(), of.logged ? degrees : QString(), metres, degrees},
                            QObject::tr("range, and bearing counter-clockwise from its heading")));
    const std::vector<std::string> subjects = of.subjects();
    if (subjects.empty() && !(of.real.empty() && of.simulated.empty())) {
        const auto nothing = [](const auto& looks) {
            return looks.empty() ? QStringList{"", ""} : QStringList{QObject::tr("none"), ""};
        };
        rows.push_back(
            tableRow("", nothing(of.real) + nothing(of.simulated), QObject::tr("it looked, and reported nothing")));
    }
    for (const std::string& name : subjects) {
        const QStringList real = of.logged ? readingCells(of.in(of.real, name)) : QStringList{"", ""};
        rows.push_back(
            tableRow(qtText(name), real + readingCells(of.in(of.simulated, name)),
                     QObject::tr("%1: %2\nsimulated: %3")
                         .arg(realWord(write.frame), truthText(of.real, name), truthText(of.simulated, name))));
    }
    return table;
}

/// Of each element of a sensor of what surrounds its robot.
InspectorRow rowsOf(const RowWriter& write, const SensorScan& scan, const RowIsOpen& isOpen, const QString& path) {
    const Reading& reading = *scan.known.reading;
    InspectorRow table = RowWriter::text(qtText(scan.known.sensor->name()),
                                         QObject::tr("%1 elements, %2 s ago")
                                             .arg(reading.count)
                                             .arg(fixedText(toSeconds(write.frame.now() - reading.measured), 2)));
    auto& rows = table.children;
    const bool open = isOpen(path + '/' + table.id);
    const auto add = [&](std::size_t element, double bearing, const QStringList& cells) {
        rows.push_back(tableRow(QString::number(element + 1), QStringList{bearingText(bearing)} + cells));
    };
    const QString degrees = QString::fromUtf8("\u00b0");
    const auto head = [&](const QStringList& cells) {
        rows.push_back(tableRow(QObject::tr("element"), QStringList{degrees} + cells,
                                QObject::tr("its direction, counter-clockwise from the robot's heading")));
    };
    const std::size_t shown = open ? reading.count : 0;
    if (scan.kind == SensorScan::Kind::infrared) {
        head({QObject::tr("intensity")});
        const auto echoes = scan.known.records<InfraredEcho>();
        for (std::size_t i = 0; i < shown; ++i) add(i, echoes[i].bearing, {fixedText(echoes[i].intensity, 3)});
    } else if (scan.kind == SensorScan::Kind::bumpers) {
        head({QObject::tr("pressed"), QObject::tr("touches")});
        const auto contacts = scan.known.records<BumperContact>();
        for (std::size_t i = 0; i < shown; ++i)
            add(i, contacts[i].bearing, {QString::number(contacts[i].pressed), QString::number(contacts[i].touches)});
    } else if (scan.kind == SensorScan::Kind::lineCamera) {
        head({QObject::tr("class")});
        const auto pixels = scan.known.records<ColourPixel>();
        for (std::size_t i = 0; i < shown; ++i)
            add(i, pixels[i].bearing, {qtText(std::string(wordOf(pixels[i].colourClass)))});
    } else {
        head({"m"});
        const auto echoes = scan.known.records<RangeEcho>();
        for (std::size_t i = 0; i < shown; ++i)
            add(i, echoes[i].bearing, {std::isfinite(echoes[i].range) ? fixedText(echoes[i].range, 3) : noValue()});
    }
    return table;
}

}  // namespace

std::optional<InspectorRow> readingRows(const RowWriter& write, const RowIsOpen& isOpen) {
    const std::vector<SensorLook> real = realLooks(write.frame, write.body);
    const std::vector<SensorLook> simulated = simulatedLooks(write.frame, write.body);
    InspectorRow section = RowWriter::section(QObject::tr("Readings"));
    for (const SensorRows& sensor : sensorRows(write, simulated, real))
        section.children.push_back(rowsOf(write, sensor));
    for (const SensorScan& scan : scansOf(write.frame, write.body))
        section.children.push_back(rowsOf(write, scan, isOpen, section.id));
    if (section.children.empty()) return std::nullopt;
    return section;
}

}  // namespace mrose
