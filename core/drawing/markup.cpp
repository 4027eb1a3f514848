#include "drawing/markup.h"

#include <algorithm>
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

std::string attribute(std::string_view cssClass) {
    return cssClass.empty() ? std::string{} : cat(" class=\"", cssClass, "\"");
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

std::string element(std::string_view tag, std::string_view cssClass, std::string_view content) {
    return cat("<", tag, attribute(cssClass), ">", content, "</", tag, ">\n");
}

HtmlTable::HtmlTable(std::vector<std::string> header, std::string cssClass)
    : header_(std::move(header)), cssClass_(std::move(cssClass)) {}

void HtmlTable::group(std::string_view content, std::size_t columns) {
    groups_ += cat("<th colspan=\"", std::to_string(columns), "\">", content, "</th>");
}

void HtmlTable::part(std::string_view content) {
    rows_ += cat("<tr class=\"part\"><th colspan=\"", std::to_string(header_.size()), "\">", content, "</th></tr>\n");
}

void HtmlTable::row(const std::vector<std::string>& cells, std::string_view cssClass) {
    rows_ += cat("<tr", attribute(cssClass), ">");
    for (std::size_t i = 0; i < cells.size(); ++i)
        rows_ += i == 0 ? cat("<th scope=\"row\">", cells[i], "</th>") : cat("<td>", cells[i], "</td>");
    rows_ += "</tr>\n";
}

std::string HtmlTable::text() const {
    std::string head = groups_.empty() ? "" : cat("<tr class=\"groups\">", groups_, "</tr>\n");
    const bool titled = std::any_of(header_.begin(), header_.end(), [](const std::string& h) { return !h.empty(); });
    if (titled) {
        head += "<tr>";
        for (const std::string& cell : header_) head += cat("<th scope=\"col\">", cell, "</th>");
        head += "</tr>";
    }
    if (!head.empty()) head = cat("<thead>\n", head, "</thead>");
    return cat("<div class=\"scroll\"><table", attribute(cssClass_), ">", head, "<tbody>\n", rows_,
               "</tbody></table></div>\n");
}

}  // namespace mrose
