#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace mrose {

struct LuaToken {
    enum class Kind { name, reserved, number, string, other };
    Kind kind = Kind::other;
    std::size_t begin = 0, end = 0;  ///< in the text
};

/// Splits a text that Lua accepts into tokens, without comments; runs to the text's end, and never beyond, for any
/// other.
std::vector<LuaToken> luaTokens(std::string_view text);

/// Where a text, one that Lua accepts, first raises to another power than 2: Lua multiplies for that one alone, and for
/// all others calls the C library, whose powers differ from processor to processor.
std::optional<std::size_t> findPower(std::string_view text);

}  // namespace mrose
