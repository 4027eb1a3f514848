// What a robot told others and was told in the last second.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "widgets/field_readout.h"
#include "widgets/fixed_text.h"
#include "widgets/inspector_rows.h"
#include "widgets/qt_text.h"

namespace mrose {
namespace {

constexpr int mostMessageRows = 6;

/// Numbers of one kind without a gap; empty where these are none that anybody would send.
template <class Number>
QString numbersIn(std::span<const std::byte> bytes) {
    if (bytes.empty() || bytes.size() % sizeof(Number) != 0) return {};
    QStringList numbers;
    for (std::size_t begin = 0; begin < bytes.size(); begin += sizeof(Number)) {
        Number number{};
        std::memcpy(&number, bytes.data() + begin, sizeof number);
        const double size = std::abs(static_cast<double>(number));
        if (size != 0 && !(size >= 1e-9 && size <= 1e9)) return {};
        numbers += QString::number(static_cast<double>(number), 'g', 6);
    }
    return numbers.join(", ");
}

InspectorRow messageRow(const QString& id, const QString& name, const QString& value, const SentMessage& message) {
    InspectorRow row = RowWriter::text(name, value);
    row.id = id;
    const auto bytes = std::span(message.bytes).first(message.size);
    QString numbers = numbersIn<double>(bytes);
    if (numbers.isEmpty()) numbers = numbersIn<float>(bytes);
    if (!numbers.isEmpty())
        row.children.push_back(RowWriter::text(QObject::tr("as numbers"), numbers,
                                               QObject::tr("little-endian floating-point numbers of %1 bytes")
                                                   .arg(numbersIn<double>(bytes).isEmpty() ? 4 : 8)));
    for (InspectorRow& bytesRow : hexRows(bytes)) row.children.push_back(std::move(bytesRow));
    return row;
}

InspectorRow dueRow(const RowWriter& write, const RadioLog::Entry& entry, const QString& id) {
    const Scene& scene = write.frame.scene();
    const Nanoseconds sent = scene.timeOf(entry.message.tick);
    InspectorRow row =
        messageRow(id, qtText(write.frame.nameOf(entry.message.from)), messageText(write.frame, entry), entry.message);
    row.quiet = entry.transmission.outcome != Transmission::Outcome::received;
    row.tip = QObject::tr("sent at %1, arrived %2 later, due at %3, %4 after it was sent")
                  .arg(clockText(sent), millisecondsText(entry.transmission.arrival - sent),
                       clockText(scene.timeOf(entry.tick)), millisecondsText(scene.timeOf(entry.tick) - sent));
    return row;
}

InspectorRow sentRow(const RowWriter& write, const SentMessage& message, const QString& id) {
    const QString to = message.to == noBody ? QObject::tr("all") : qtText(write.frame.nameOf(message.to));
    const Nanoseconds sent = write.frame.scene().timeOf(message.tick);
    InspectorRow row = messageRow(id, to, QString("%1, %2").arg(kindAndSize(message), clockText(sent)), message);
    row.tip = QObject::tr("sent at %1").arg(clockText(sent));
    return row;
}

/// The newest first.
template <class T, class Is, class Row>
InspectorRow newestRows(const QString& name, const QString& tip, const std::vector<T>& all, Is is, Row row) {
    InspectorRow section = RowWriter::text(name, {}, tip);
    section.open = true;
    int count = 0;
    for (auto entry = all.rbegin(); entry != all.rend(); ++entry) {
        if (!is(*entry)) continue;
        if (count < mostMessageRows) section.children.push_back(row(*entry, QString::number(count)));
        ++count;
    }
    section.quiet = count == 0;
    section.value = count == 0 ? QObject::tr("none") : QObject::tr("%1 in the last second").arg(count);
    return section;
}

}  // namespace

InspectorRow radioRows(const RowWriter& write) {
    InspectorRow section = write.section("Radio");
    const RadioLog& log = write.frame.radio;
    section.children.push_back(newestRows(
        QObject::tr("Received"), QObject::tr("from whom, what, and how long after it was sent; or that it was not"),
        log.due, [&](const RadioLog::Entry& entry) { return entry.transmission.to == write.body; },
        [&](const RadioLog::Entry& entry, const QString& id) { return dueRow(write, entry, id); }));
    section.children.push_back(newestRows(
        QObject::tr("Sent"), QObject::tr("to whom, what and when"), log.sent,
        [&](const SentMessage& message) { return message.from == write.body; },
        [&](const SentMessage& message, const QString& id) { return sentRow(write, message, id); }));
    const std::string& team = write.frame.scene().robots[write.body].team;
    if (!team.empty())
        section.children.insert(section.children.begin(), RowWriter::text(QObject::tr("Team"), qtText(team)));
    section.open = write.at.scenario->readsMessages(write.body);
    return section;
}

}  // namespace mrose
