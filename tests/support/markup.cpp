#include "support/markup.h"

#include <regex>
#include <vector>

namespace mrose {

std::string markupError(const std::string& text) {
    std::vector<std::string> open;
    const std::regex tag(R"re(<(/?)([a-z0-9A-Z]+)((?: [a-zA-Z-]+="[^"<>]*")*)(/?)>|[<>]|&(?!(amp|lt|gt|quot|#39);))re");
    std::string::const_iterator at = text.begin();
    if (const auto style = text.find("</style>"); style != std::string::npos) {  // no markup within
        const std::string begin = text.substr(0, text.find("<style>"));
        if (!begin.starts_with("<!DOCTYPE html>\n")) return "no doctype";
        return markupError(begin.substr(16) + text.substr(style + 8));
    }
    for (std::smatch match; std::regex_search(at, text.end(), match, tag); at = match.suffix().first) {
        const std::string found = match.str(), behind = std::string(match.suffix()).substr(0, 40);
        if (!match[2].matched) return "a stray " + found + " before " + behind;
        const bool closes = match[1].length() > 0;
        if (closes && (open.empty() || open.back() != match[2])) return "an unexpected " + found + " before " + behind;
        if (closes) open.pop_back();
        if (!closes && match[4].length() == 0) open.push_back(match[2]);
    }
    return open.empty() ? "" : "<" + open.back() + "> stays open";
}

std::size_t countOf(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
    return count;
}

}  // namespace mrose
