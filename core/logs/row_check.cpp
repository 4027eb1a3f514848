#include "logs/row_check.h"

#include <cctype>
#include <cstdio>
#include <filesystem>

namespace mrose {

std::string quoted(std::string_view text, const char* character, std::string_view separators) {
    constexpr std::size_t longest = 24;
    std::string_view rest = text.substr(static_cast<std::size_t>(character - text.data()));
    rest = rest.substr(0, rest.find_first_of(separators));
    std::string result = "'";
    for (const char c : rest.substr(0, longest)) result += std::isprint(static_cast<unsigned char>(c)) != 0 ? c : '?';
    result += rest.size() > longest ? "...'" : "'";
    return result;
}

std::string noNumberCause(std::string_view text, const char* character, std::string_view separators, bool instant) {
    const std::string expected =
        instant ? "expected seconds within +-4e9, found " : "expected a number within +-1e9, found ";
    return expected + quoted(text, character, separators);
}

tl::unexpected<Error> failAt(const std::string& name, std::string_view text, const char* character, std::string key,
                             std::string cause) {
    const TextPosition position = positionIn(text, character);
    return tl::unexpected<Error>(Error{name, position.line, position.column, std::move(key), std::move(cause)});
}

std::string backwardsCause(const ClockReset& reset, int latestLine) {
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, "%.3f", toSeconds(reset.behind));
    return "time runs backwards for good: " + std::string(seconds) + " s before line " + std::to_string(latestLine);
}

std::string tooShortCause(std::size_t rows) {
    return "too short: " + std::to_string(rows) + (rows == 1 ? " row" : " rows") + "; expected at least " +
           std::to_string(fewestRows);
}

std::string cutLineText(const std::string& path) {
    return "The last line of " + std::filesystem::path(path).filename().string() + " is cut off: it is left out.";
}

std::string tooShortText(const std::string& path, std::size_t rows) {
    return std::filesystem::path(path).filename().string() + (rows == 0 ? " has no rows" : " has a single row");
}

}  // namespace mrose
