#pragma once

#include <string_view>

namespace mrose {

/// The style sheet of reports, light and dark. Series colours are Okabe and Ito's, which stay apart for colour-blind
/// eyes; dashes distinguish the series without colour.
extern const std::string_view reportStyle;

constexpr int seriesStyles = 6;  ///< classes s0 ... s5

}  // namespace mrose
