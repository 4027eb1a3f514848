#pragma once

#include <string>
#include <string_view>

namespace mrose {

/// A measure's name as people read it, with the unit that it ends in, if it does: "time_s" is "time (s)",
/// "none_percent" is "none (%)".
std::string measureLabel(std::string_view name);

}  // namespace mrose
