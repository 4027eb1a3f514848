#include "io/format.h"

#include <array>
#include <charconv>
#include <cmath>

namespace mrose {

std::string fixed(double value, int decimals) {
    if (!std::isfinite(value)) return "–";
    std::array<char, 400> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals);
    const std::string result(text.data(), end.ptr);
    const bool onlyZeros = result.find_first_not_of("-0.") == std::string::npos;
    return onlyZeros && result.front() == '-' ? result.substr(1) : result;
}

std::string exact(double value) {
    if (!std::isfinite(value)) return "null";
    std::array<char, 40> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

std::string csvCell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string result = "\"";
    for (const char c : text) result.append(c == '"' ? 2 : 1, c);
    return result + "\"";
}

}  // namespace mrose
