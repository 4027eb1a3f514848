#include "recording/json_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace mrose {
namespace {

void appendInteger(std::string& json, std::int64_t value) {
    std::array<char, 24> text;
    json.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

/// How many bytes of well-formed UTF-8 the text begins with as one character; 0 for none.
std::size_t characterLength(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::size_t length = byte(0) < 0x80 ? 1 : byte(0) < 0xc2 ? 0 : byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
    if (length == 0 || byte(0) > 0xf4 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if (byte(i) >> 6 != 2) return 0;
    const bool overlong = (byte(0) == 0xe0 && byte(1) < 0xa0) || (byte(0) == 0xf0 && byte(1) < 0x90);
    const bool beyond = (byte(0) == 0xed && byte(1) > 0x9f) || (byte(0) == 0xf4 && byte(1) > 0x8f);
    return overlong || beyond ? 0 : length;
}

}  // namespace

void appendFixed(std::string& json, double value, int decimals) {
    constexpr std::array<double, 7> powers{1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6};
    constexpr double mostExact = 9e15;
    const double scaled = value * powers[static_cast<std::size_t>(decimals)];
    if (!std::isfinite(scaled)) {
        json += "null";
        return;
    }
    if (std::fabs(scaled) > mostExact) {
        std::array<char, 32> text;
        json.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
        return;
    }
    const std::int64_t rest = std::llround(std::fabs(scaled));
    if (value < 0 && rest != 0) json += '-';
    std::array<char, 24> digits;
    const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), rest).ptr;
    const auto count = static_cast<int>(end - digits.data());
    json.append(digits.data(), static_cast<std::size_t>(std::max(count - decimals, 0)));
    if (count <= decimals) json += '0';
    if (decimals == 0) return;
    json += '.';
    json.append(static_cast<std::size_t>(std::max(decimals - count, 0)), '0');
    json.append(end - std::min(count, decimals), end);
}

void appendQuoted(std::string& json, std::string_view text) {
    json += '"';
    while (!text.empty()) {
        const std::size_t length = characterLength(text);
        const char c = text[0];
        if (c == '"' || c == '\\') {
            json += '\\';
            json += c;
        } else if (static_cast<unsigned char>(c) < 0x20) {
            constexpr std::string_view hex = "0123456789abcdef";
            json += "\\u00";
            json += hex[static_cast<unsigned char>(c) >> 4];
            json += hex[c & 15];
        } else if (length == 0) {
            json += '?';
        } else {
            json += text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    json += '"';
}

void appendTime(std::string& json, Nanoseconds time) {
    json += "{\"sec\":";
    appendInteger(json, time / nanosecondsPerSecond);
    json += ",\"nsec\":";
    appendInteger(json, time % nanosecondsPerSecond);
    json += '}';
}

}  // namespace mrose
