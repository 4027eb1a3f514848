#pragma once

#include <vector>

#include <QString>

#include "widgets/field_frame.h"

namespace mrose {

/// What is known of a body at the shown tick, as a person reads it: every number with its unit.
struct InspectorSection {
    struct Row {
        QString name, value, tip;
        bool notable = false;  ///< contact changed something, a controller failed
    };
    QString title;
    std::vector<Row> rows;
};
std::vector<InspectorSection> inspectorSections(const FieldFrame& frame, std::size_t body);

}  // namespace mrose
