// What a robot thinks: its controller's decision and memory, and what it perceives.
#include <algorithm>
#include <bit>
#include <cstring>
#include <span>

#include "quantities/note_label.h"
#include "quantities/part.h"
#include "widgets/fixed_text.h"
#include "widgets/inspector_rows.h"
#include "widgets/qt_text.h"

namespace mrose {
namespace {

/// Of more robots only those in sight are listed.
constexpr std::size_t mostListed = 24;
constexpr std::size_t mostHexBytes = 4096, bytesInRow = 8;

QString pointText(const Point& point) { return QString("%1, %2 m").arg(fixedText(point.x, 2), fixedText(point.y, 2)); }

/// An error differs from a value by its unit: "0.023 m off".
InspectorRow asError(InspectorRow row) {
    if (!row.quiet) row.unit = QObject::tr("%1 off").arg(row.unit);
    return row;
}

InspectorRow noteRow(const RowWriter& write, const Annotation& note) {
    const Quantity& quantity = quantityNamed("note", Quantity::Of::items);
    const NoteLabel label = noteLabel(note.label);
    if (note.kind == Annotation::Kind::value) return write.item(quantity, {label.name, label.unit});
    if (note.kind == Annotation::Kind::text) return write.item(quantity, {note.label, ""});
    InspectorRow row = RowWriter::text(qtText(note.label), {}, QObject::tr(quantity.what));
    if (note.points.empty()) return row;
    row.value = pointText(note.points.front());
    if (note.kind == Annotation::Kind::line) row.value += QString::fromUtf8(" \u2192 ") + pointText(note.points.back());
    for (const char* const axis : {"note_x", "note_y"}) {
        row.children.push_back(write.item(quantityNamed(axis, Quantity::Of::items), {note.label, ""}));
        row.children.back().name = axis;
    }
    return row;
}

/// `part`: whose memory it is.
InspectorRow entryRow(const RowWriter& write, const MemoryEntry& entry, std::uint32_t part) {
    return write.value({&partQuantity(), write.body, part, entry.name, entry.unit}, qtText(entry.name));
}

QString hexText(std::span<const std::byte> bytes) {
    QString text;
    for (const std::byte byte : bytes) text += QString("%1 ").arg(std::to_integer<int>(byte), 2, 16, QChar('0'));
    return text.trimmed();
}

/// Eight bytes may be a number of either kind.
QString readingsText(std::span<const std::byte> bytes) {
    if (bytes.size() < bytesInRow) return {};
    std::uint64_t bits = 0;
    std::memcpy(&bits, bytes.data(), bytesInRow);
    return QObject::tr("as a floating-point number %1\nas an integer %2")
        .arg(std::bit_cast<double>(bits), 0, 'g', 10)
        .arg(static_cast<qint64>(bits));
}

InspectorRow seenRow(const RowWriter& write, std::uint32_t other) {
    InspectorRow row = asError(write.value(quantityNamed("seen_error", Quantity::Of::seenPair), other));
    row.id = row.name = qtText(write.frame.nameOf(other));
    if (row.quiet) {
        const bool robot = other < write.frame.scene().robots.size();
        const bool asked = write.at.scenario->attention(write.body).reads(robot ? robotsReading : objectsReading);
        row.value = asked ? QObject::tr("not in sight") : QObject::tr("not asked");
        row.unit.clear();
    }
    for (const Quantity& quantity : quantities())
        if (quantity.of == Quantity::Of::seenPair || quantity.of == Quantity::Of::pair)
            row.children.push_back(write.value(quantity, other));
    const RowWriter theirs(write.frame, other);
    for (const auto& [name, quantity] : {std::pair{QObject::tr("true x"), "x"}, {QObject::tr("true y"), "y"}}) {
        row.children.push_back(theirs.value(quantityNamed(quantity, Quantity::Of::body)));
        row.children.back().name = name;
    }
    return row;
}

/// What its motion model and its sensors remember and report: a row for each of them that says something.
void addOtherParts(const RowWriter& write, InspectorRow& section) {
    const std::vector<std::string> names = partNames(*write.at.scenario, write.body);
    for (std::uint32_t part = 1; part < names.size(); ++part) {
        const std::vector<MemoryEntry> entries = partEntries(write.at, write.body, part);
        if (entries.empty()) continue;
        InspectorRow row = RowWriter::text(qtText(names[part]), QObject::tr("%1 values").arg(entries.size()));
        for (const MemoryEntry& entry : entries) row.children.push_back(entryRow(write, entry, part));
        section.children.push_back(std::move(row));
    }
}

bool inSight(const RowWriter& write, std::size_t robot) {
    const std::span<const SeenBody> seen = write.frame.insights[write.body].observation.robots();
    return std::any_of(seen.begin(), seen.end(), [&](const SeenBody& body) { return body.index == robot; });
}

}  // namespace

std::vector<InspectorRow> hexRows(std::span<const std::byte> memory, std::span<const std::byte> before) {
    std::vector<InspectorRow> rows;
    const std::size_t shown = std::min(memory.size(), mostHexBytes);
    for (std::size_t begin = 0; begin < shown; begin += bytesInRow) {
        const auto bytes = memory.subspan(begin, std::min(bytesInRow, memory.size() - begin));
        InspectorRow row = RowWriter::text(QString::number(begin), hexText(bytes), readingsText(bytes));
        row.wide = true;
        row.notable = before.size() == memory.size() &&
                      !std::equal(bytes.begin(), bytes.end(), before.begin() + static_cast<std::ptrdiff_t>(begin));
        rows.push_back(std::move(row));
    }
    if (shown < memory.size())
        rows.push_back(RowWriter::text(QObject::tr("more"), QObject::tr("%1 bytes").arg(memory.size() - shown)));
    return rows;
}

InspectorRow controllerRows(const RowWriter& write) {
    InspectorRow section = RowWriter::section(QObject::tr("Controller"));
    auto& rows = section.children;
    const RobotInsight& insight = write.frame.insights[write.body];
    const QString decided =
        insight.tick < 0 ? QObject::tr("not yet") : clockText(write.frame.scene().timeOf(insight.tick));
    rows.push_back(RowWriter::text(QObject::tr("Decided at"), decided, QObject::tr("its last control instant")));
    const Decision& decision = insight.decision;
    rows.push_back(RowWriter::text(
        QObject::tr("Command"),
        insight.tick < 0 ? QString::fromUtf8("\u2013")
        : !decision.command
            ? QObject::tr("go on as before")
            : QString("%1 m/s, %2 rad/s").arg(fixedText(decision.command->v, 2), fixedText(decision.command->w, 2))));
    const auto notable = [&](const QString& name, const QString& value) {
        rows.push_back(RowWriter::text(name, value));
        rows.back().notable = true;
    };
    for (const Kick& kick : decision.kicks)
        notable(QObject::tr("Kick"), QObject::tr("with %1 % of its power").arg(fixedText(100 * kick.power, 0)));
    for (const Annotation& note : decision.annotations) rows.push_back(noteRow(write, note));
    if (!decision.breakReason.empty()) notable(QObject::tr("Stop"), qtText(decision.breakReason));
    if (!decision.fault.empty()) notable(QObject::tr("Failed"), qtText(decision.fault));
    return section;
}

InspectorRow memoryRows(const RowWriter& write, const RowIsOpen& isOpen) {
    InspectorRow section = RowWriter::section(QObject::tr("Memory"), false);
    const std::span<const std::byte> memory = write.at.scenario->memoryOf(*write.at.state, write.body);
    const std::vector<std::byte>& before = write.frame.insights[write.body].memoryBefore;
    std::size_t changed = 0;
    if (before.size() == memory.size())
        for (std::size_t i = 0; i < memory.size(); ++i) changed += memory[i] != before[i] ? 1 : 0;
    section.value =
        memory.empty() ? QObject::tr("none") : QObject::tr("%1 bytes, %2 changed").arg(memory.size()).arg(changed);
    section.tip = QObject::tr("what its controller keeps, and how many bytes of it the last decision changed");
    section.quiet = memory.empty();
    if (memory.empty()) {
        addOtherParts(write, section);
        return section;
    }
    const Controller& controller = write.at.scenario->controller(write.body);
    const bool open = isOpen(section.id);
    const std::vector<MemoryEntry> entries = open ? explained(controller, memory) : std::vector<MemoryEntry>();
    const std::vector<MemoryEntry> old =
        open && before.size() == memory.size() ? explained(controller, before) : entries;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        section.children.push_back(entryRow(write, entries[i], 0));
        const bool same = i < old.size() && old[i].name == entries[i].name && old[i].text == entries[i].text;
        section.children.back().notable = !same;
    }
    InspectorRow bytes = RowWriter::text(QObject::tr("Bytes"), QObject::tr("hexadecimal"));
    bytes.children = isOpen(section.id + '/' + bytes.id) ? hexRows(memory, before)
                                                         : std::vector{RowWriter::text(QString(), QString())};
    section.children.push_back(std::move(bytes));
    addOtherParts(write, section);
    return section;
}

InspectorRow perceptionRows(const RowWriter& write) {
    InspectorRow section = RowWriter::section(QObject::tr("Sees"));
    auto& rows = section.children;
    const RobotInsight& insight = write.frame.insights[write.body];
    if (!insight.observed) {
        section.value = QObject::tr("nothing yet");
        section.quiet = true;
    }
    InspectorRow all = write.section("Sees");
    InspectorRow self = asError(all.children.front());
    self.name = QObject::tr("Itself");
    if (self.quiet) {
        self.value = QObject::tr("not yet");
        self.unit.clear();
    }
    self.children.assign(all.children.begin() + 1, all.children.end());
    rows.push_back(std::move(self));
    const std::size_t robots = write.frame.state.robots.size();
    for (auto other = static_cast<std::uint32_t>(robots); other < write.frame.scene().bodyCount(); ++other)
        rows.push_back(seenRow(write, other));
    for (std::uint32_t other = 0; other < robots; ++other)
        if (other != write.body && (robots <= mostListed || inSight(write, other)))
            rows.push_back(seenRow(write, other));
    return section;
}

}  // namespace mrose
