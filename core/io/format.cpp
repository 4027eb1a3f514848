#include "io/format.h"

#include <array>
#include <charconv>
#include <cinttypes>
#include <cmath>
#include <cstdio>

namespace mrose {
namespace {

constexpr double leastPlain = 1e-3, mostPlain = 1e15;

template <class Float>
std::string shortest(Float value) {
    char text[40];
    const Float size = value < 0 ? -value : value;
    // to_chars itself prefers 1e+05 where that is the shorter text.
    const bool plain = size >= Float(leastPlain) && size < Float(mostPlain);
    const auto end = plain ? std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr
                           : std::to_chars(text, text + sizeof text, value).ptr;
    std::string result(text, end);
    if (result.find_first_of(".en") == std::string::npos) result += ".0";
    return result;
}

}  // namespace

std::string fixed(double value, int decimals) {
    if (!std::isfinite(value)) return "–";
    std::array<char, 400> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
    const std::string result(text.data(), end.ptr);
    const bool onlyZeros = result.find_first_not_of("-0.") == std::string::npos;
    return onlyZeros && result.front() == '-' ? result.substr(1) : result;
}

std::string fixedWithMinus(double value, int decimals) {
    const std::string text = fixed(value, decimals);
    return text.starts_with('-') ? "−" + text.substr(1) : text;
}

std::string plainNumberText(double value) {
    const std::string text = numberText(value);
    return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

std::string numberText(double value) { return shortest(value); }
std::string numberText(float value) { return shortest(value); }

std::string hexadecimal(std::uint64_t value) {
    char text[17];
    std::snprintf(text, sizeof text, "%016" PRIx64, value);
    return text;
}

std::string counted(std::size_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

std::string counted(std::size_t count, const std::string& one) { return counted(count, one, one + 's'); }

std::string csvCell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result.append(c == '"' ? 2 : 1, c);
    return result + "\"";
}

}  // namespace mrose
