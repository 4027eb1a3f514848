#include "io/text_position.h"

#include <algorithm>

namespace mrose {

TextPosition positionIn(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto lines = std::count(before.begin(), before.end(), '\n');
    const std::size_t lineStart = before.rfind('\n') + 1;  // npos + 1 is 0
    return {static_cast<int>(lines) + 1, static_cast<int>(before.size() - lineStart) + 1};
}

}  // namespace mrose
