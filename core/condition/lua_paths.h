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
};

/// All paths in a text that Lua accepts as an expression. Empty for texts that define functions: their names may be
/// local.
std::vector<LuaPath> luaPaths(std::string_view text);

}  // namespace mrose
