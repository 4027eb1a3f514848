#include "io/base64.h"

#include <cstdint>

namespace mrose {
namespace {

constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::string base64(std::string_view bytes, std::size_t width) {
    std::string text;
    std::size_t inLine = 0;
    const auto add = [&](char letter) {
        if (inLine == width) {
            text += '\n';
            inLine = 0;
        }
        text += letter;
        ++inLine;
    };
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) add(i + k <= bytes.size() ? letters[group >> (18 - 6 * k) & 63] : '=');
    }
    return text;
}

std::optional<std::string> fromBase64(std::string_view text) {
    std::string bytes;
    std::uint32_t group = 0;
    int count = 0, padding = 0;
    for (const char c : text) {
        if (c == '\n' || c == '\r' || c == ' ') continue;
        const std::size_t value = c == '=' ? 0 : letters.find(c);
        if (value == std::string_view::npos || (padding > 0 && c != '=')) return std::nullopt;
        padding += c == '=';
        group = group << 6 | static_cast<std::uint32_t>(value);
        if (++count < 4) continue;
        if (padding > 2) return std::nullopt;
        for (int k = 0; k < 3 - padding; ++k) bytes += static_cast<char>(group >> (16 - 8 * k) & 255);
        group = 0;
        count = 0;
        if (padding > 0) padding = 3;  // nothing may follow
    }
    return count == 0 ? std::optional(std::move(bytes)) : std::nullopt;
}

}  // namespace mrose
