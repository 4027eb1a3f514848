#pragma once

#include <cstdint>
#include <numbers>
#include <string>

namespace mrose {

/// In a radian.
constexpr double degrees = 180 / std::numbers::pi;

/// `value` with a fixed number of decimals and a point, whatever the locale; "–" when it is not finite.
std::string fixed(double value, int decimals);
/// The same with a minus sign instead of a hyphen: for pages.
std::string fixedWithMinus(double value, int decimals);

/// The shortest decimal text that reads back as the same number, without exponent from 0.001 on to below 1e15; always
/// with '.', exponent, "inf" or "nan", so that it is a float wherever integers and floats differ. Independent of the
/// locale.
std::string numberText(double value);
std::string numberText(float value);
/// The same as people write it: 64, not 64.0.
std::string plainNumberText(double value);

/// 16 hexadecimal digits.
std::string hexadecimal(std::uint64_t value);

/// "1 wall", "4 walls".
std::string counted(std::size_t count, const std::string& one, const std::string& many);
std::string counted(std::size_t count, const std::string& one);  ///< many: with an s

/// Text as a cell of a CSV file: quoted where it needs it.
std::string csvCell(const std::string& text);

}  // namespace mrose
