#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "io/error.h"

namespace mrose {

/// Where a value is, or is to be: a table by its path, "" for the file itself, "robot[2].controller"; and its key.
struct TomlPlace {
    std::string table;
    std::string key;
    std::string after = {};  ///< a new key comes into the line below this one, where the table has it
};

/// The text with this value, as TOML writes it, at this place; all else stays as it is, comments too. Error: the text
/// has a syntax error, or no such table.
Expected<std::string> withTomlValue(const std::string& text, const std::string& file, const TomlPlace& place,
                                    const std::string& value);

/// The path of the table in one of these arrays whose `name` is this one: "robot[2]"; "" where there is none. Error:
/// the text has a syntax error.
Expected<std::string> tomlTableNamed(const std::string& text, const std::string& file,
                                     std::initializer_list<const char*> arrays, const std::string& name);

/// A string as TOML writes it.
std::string tomlString(std::string_view text);

}  // namespace mrose
