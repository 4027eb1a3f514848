#include "report/measure_label.h"

#include <algorithm>
#include <array>

#include "io/format.h"

namespace mrose {
namespace {

struct NamedUnit {
    std::string_view ending, shown;
};
constexpr std::array units{NamedUnit{"percent", "%"},   NamedUnit{"s", "s"},      NamedUnit{"min", "min"},
                           NamedUnit{"h", "h"},         NamedUnit{"m", "m"},      NamedUnit{"cm", "cm"},
                           NamedUnit{"mps", "m/s"},     NamedUnit{"rad", "rad"},  NamedUnit{"deg", "°"},
                           NamedUnit{"radps", "rad/s"}, NamedUnit{"degps", "°/s"}};

/// The unit that a name ends in, and where that begins; nullptr: it does not.
const NamedUnit* unitAtEnd(std::string_view name, std::size_t& end) {
    end = name.rfind('_');
    if (end == std::string_view::npos || end == 0) return nullptr;
    const auto found = std::ranges::find(units, name.substr(end + 1), &NamedUnit::ending);
    return found == units.end() ? nullptr : &*found;
}

std::string withSpaces(std::string_view name) {
    std::string text(name);
    std::ranges::replace(text, '_', ' ');
    return text;
}

}  // namespace

std::string measureName(std::string_view name) {
    std::size_t end = 0;
    return withSpaces(unitAtEnd(name, end) != nullptr ? name.substr(0, end) : name);
}

std::string measureLabel(std::string_view name) {
    std::size_t end = 0;
    const NamedUnit* const unit = unitAtEnd(name, end);
    return unit != nullptr ? cat(withSpaces(name.substr(0, end)), " (", unit->shown, ")") : withSpaces(name);
}

}  // namespace mrose
