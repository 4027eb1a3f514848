#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"

namespace mrose {

/// Where a value is, or is to be: a table by its path, "" for the file itself, "robot[2].controller"; and its key.
struct TomlPlace {
    std::string table;
    std::string key;
    std::string after = {};  ///< a new key comes into the line below this one, where the table has it
};

struct TomlEdit {
    TomlPlace place;
    std::string value;  ///< as TOML writes it
};
/// The text with these values at their places; all else stays as it is, comments too. Error: the text has a syntax
/// error, or no such table.
Expected<std::string> withTomlValues(const std::string& text, const std::string& file, std::span<const TomlEdit> edits);
inline Expected<std::string> withTomlValue(const std::string& text, const std::string& file, const TomlPlace& place,
                                           const std::string& value) {
    const TomlEdit edit{place, value};
    return withTomlValues(text, file, {&edit, 1});
}

/// The text without one table of an array of tables, by its path: "robot[2]", with all that belongs to it. Error: the
/// text has a syntax error; the table is not one that stands under a [[header]] of its own.
Expected<std::string> withoutTomlTable(const std::string& text, const std::string& file, const std::string& path);

/// A string in a text: where it is, and what it says.
struct TomlString {
    TomlPlace place;
    std::string value;
};
/// The strings that some keys hold: "environment" of the file itself, "robot[].controller.log" of each table of an
/// array. Error: the text has a syntax error.
Expected<std::vector<TomlString>> tomlStrings(const std::string& text, const std::string& file, std::string_view path);

/// The path of the table in one of these arrays whose `name` is this one: "robot[2]"; "" where there is none. Error:
/// the text has a syntax error.
Expected<std::string> tomlTableNamed(const std::string& text, const std::string& file,
                                     std::initializer_list<const char*> arrays, const std::string& name);

/// A string as TOML writes it.
std::string tomlString(std::string_view text);

}  // namespace mrose
