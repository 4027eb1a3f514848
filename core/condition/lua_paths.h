#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace mrose {

/// A name in a Lua expression and what is written behind it as far as it is fixed: "robot[2].speed", but "robot" of
/// "robot[i].speed".
struct LuaPath {
    std::size_t offset = 0;  ///< in the text
    std::string_view text;
    /// A name or key in `text`, and where the path up to it ends: "speed", or "2" up to its bracket.
    struct Part {
        std::size_t begin = 0, end = 0;
    };
    std::vector<Part> parts;
};

/// All paths in a text that Lua accepts as an expression. Empty for texts that define functions: their names may be
/// local.
std::vector<LuaPath> luaPaths(std::string_view text);

/// All names and strings in any text, these without their quotation marks.
std::vector<std::string_view> luaWords(std::string_view text);

}  // namespace mrose
