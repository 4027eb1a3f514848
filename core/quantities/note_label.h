#pragma once

#include <string>

namespace mrose {

/// A note's label without the unit that it may end in: "ball speed" and "m/s" of "ball speed (m/s)".
struct NoteLabel {
    std::string name, unit;
};

inline NoteLabel noteLabel(const std::string& label) {
    const std::size_t unit = label.rfind(" (");
    if (unit == std::string::npos || unit == 0 || !label.ends_with(')')) return {label, {}};
    return {label.substr(0, unit), label.substr(unit + 2, label.size() - unit - 3)};
}

}  // namespace mrose
