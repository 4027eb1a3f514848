#pragma once

#include <numbers>
#include <string>

namespace mrose {

/// In a radian.
constexpr double degrees = 180 / std::numbers::pi;

/// `value` with a fixed number of decimals and a point, whatever the locale; "–" when it is not finite.
std::string fixed(double value, int decimals);

/// The shortest text that reads back as the same double; "null" when it is not finite (JSON has no other word).
std::string exact(double value);

/// Text as a cell of a CSV file: quoted where it needs it.
std::string csvCell(const std::string& text);

}  // namespace mrose
