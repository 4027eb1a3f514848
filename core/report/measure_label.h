#pragma once

#include <string>
#include <string_view>

namespace mrose {

// Names of measures as people read them: with spaces, and the unit in brackets that a name ends in, if it does.

/// "none (%)" of "none_percent", "touched for (s)" of "touched_for_s".
std::string measureLabel(std::string_view name);
/// The same without the unit.
std::string measureName(std::string_view name);

}  // namespace mrose
