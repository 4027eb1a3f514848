#pragma once

#include <string>
#include <string_view>

#include "io/error.h"
#include "io/value.h"

namespace mrose {

/// The tables of a TOML text, with the places of all values in it. Error: `file`, line and column of what is no TOML.
Expected<Value> parseToml(std::string_view text, const std::string& file);

/// A table as TOML, exact to the bit: what a reader looks for first comes first, files that it names are given by their
/// references. `comment` stands above it, line by line, without its marks.
std::string tomlText(const Value& table, std::string_view comment = {});

/// A string as TOML writes it.
std::string tomlString(std::string_view text);

}  // namespace mrose
