#pragma once

#include <QString>
#include <QStringList>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "debug/field_frame.h"
#include "debug/plotted_value.h"

namespace mrose {

/// A line of the inspector. `id` is its own among its brothers and stays from tick to tick, whatever its value.
struct InspectorRow {
    QString id, name;
    QString value;  ///< a number has its digits here and its unit beside
    QString unit;
    QString tip;
    std::optional<ValueKey> plot;  ///< what can be plotted of it
    bool notable = false;          ///< contact changed something, a controller failed
    bool quiet = false;            ///< nothing there just now
    bool open = false;             ///< shows its children at first
    bool wide = false;             ///< name and value are one text, in digits of equal width
    QStringList cells = {};        ///< beside the name instead of a value: columns of a table, flush right
    std::vector<InspectorRow> children = {};
};

/// Whether a row's children are shown; rows whose children are costly have them only then. `path` has the ids of the
/// row and those above it, with '/' between.
using RowIsOpen = std::function<bool(const QString& path)>;

/// What is known of a body at the shown tick, as a person reads it: every number with its unit.
std::vector<InspectorRow> inspectorRows(const FieldFrame& frame, std::size_t body, const RowIsOpen& isOpen);

/// What the inspector writes rows with: values of the catalogue, by their names there unless another is given.
class RowWriter {
public:
    RowWriter(const FieldFrame& frame, std::size_t body);

    InspectorRow value(const BoundValue& value, const QString& name) const;
    /// Of the body, and another one; noBody: what stands still.
    InspectorRow value(const Quantity& quantity, std::uint32_t other = noBody) const;
    InspectorRow item(const Quantity& quantity, const Quantity::Item& item) const;
    /// A section with all that the catalogue has for it.
    InspectorRow section(const char* name) const;
    static InspectorRow text(const QString& name, const QString& value, const QString& tip = {});
    static InspectorRow section(const QString& name, bool open = true);

    const FieldFrame& frame;
    const std::uint32_t body;
    const Moment at;
};

// The parts of it.
InspectorRow controllerRows(const RowWriter& write);
InspectorRow memoryRows(const RowWriter& write, const RowIsOpen& isOpen);
InspectorRow perceptionRows(const RowWriter& write);
/// Of sensors beyond those that every robot has, beside the real robot's; nullopt: there are none.
std::optional<InspectorRow> readingRows(const RowWriter& write, const RowIsOpen& isOpen);
/// What it told others and was told.
InspectorRow radioRows(const RowWriter& write);
/// Eight bytes a row, in hexadecimal digits; notable those that were others in `before`, if that is as long.
std::vector<InspectorRow> hexRows(std::span<const std::byte> bytes, std::span<const std::byte> before = {});

}  // namespace mrose
