#include "io/shell_quoted.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace mrose {

std::string shellQuoted(const std::string& word) {
    const auto plain = [](unsigned char c) { return std::isalnum(c) || std::strchr("-_./,:=+@%", c); };
    if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? "'\\''" : std::string(1, c);
    return out + '\'';
}

}  // namespace mrose
