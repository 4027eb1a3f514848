#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/value.h"

namespace mrose {

/// All files that a value names, each once, those that a file itself names before it.
std::vector<Value::File> filesOf(const Value& value);

/// The canonical bytes of a value with all files that it names: equal values have equal ones, but for the files' names.
/// Of files that have the content of one of `known` only the hash is written.
std::string valueBytes(const Value& value, std::span<const Value::File> known = {});

/// Back from them, with the same files known. nullopt: the bytes are not sound.
std::optional<Value> parseValue(std::string_view bytes, std::span<const Value::File> known = {});

/// Of a value's content, whatever the names of its files are.
std::uint64_t hashOf(const Value& value);

}  // namespace mrose
