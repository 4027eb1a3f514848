#pragma once

#include <cstddef>
#include <string_view>

namespace mrose {

/// The line and column, both from 1, of a byte of a text.
struct TextPosition {
    int line = 1, column = 1;
};
TextPosition positionIn(std::string_view text, std::size_t offset);
/// The same of a character in it.
inline TextPosition positionIn(std::string_view text, const char* character) {
    return positionIn(text, static_cast<std::size_t>(character - text.data()));
}

}  // namespace mrose
