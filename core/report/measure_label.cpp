#include "report/measure_label.h"

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

}  // namespace

std::string measureLabel(std::string_view name) {
    const std::size_t end = name.rfind('_');
    if (end == std::string_view::npos || end == 0) return std::string(name);
    for (const NamedUnit& unit : units)
        if (name.substr(end + 1) == unit.ending) return cat(name.substr(0, end), " (", unit.shown, ")");
    return std::string(name);
}

}  // namespace mrose
