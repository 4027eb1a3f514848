#include "drawing/markup.h"

#include <cmath>

#include "io/format.h"

namespace mrose {
namespace {

/// The length of the UTF-8 sequence at the text's begin; 0: none.
std::size_t sequenceLength(std::string_view text) {
    const auto first = static_cast<unsigned char>(text[0]);
    const std::size_t length = first < 0x80                    ? 1
                               : first >= 0xC2 && first < 0xE0 ? 2
                               : first >= 0xE0 && first < 0xF0 ? 3
                               : first >= 0xF0 && first < 0xF5 ? 4
                                                               : 0;
    if (length == 0 || length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i)
        if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
    return length;
}

}  // namespace

std::string px(double pixels) { return fixed(std::isfinite(pixels) ? pixels : 0, 2); }

std::string escaped(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const std::size_t length = sequenceLength(text);
        const char c = text[0];
        if (length == 0 || (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7F)
            result += "\uFFFD";
        else if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"')
            result += "&quot;";
        else if (c == '\'')
            result += "&#39;";
        else
            result.append(text.substr(0, length));
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return result;
}

Attributes::Attribute::Attribute(std::string_view name, std::string_view value)
    : markup(cat(" ", name, "=\"", escaped(value), "\"")) {}
Attributes::Attribute::Attribute(std::string_view name, double pixels) : Attribute(name, px(pixels)) {}

std::string element(std::string_view tag, const Attributes& attributes, std::string_view content) {
    return content.empty() ? cat("<", tag, attributes.markup(), "/>\n")
                           : cat("<", tag, attributes.markup(), ">", content, "</", tag, ">\n");
}

}  // namespace mrose
