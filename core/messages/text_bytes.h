#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/bytes.h"

namespace mrose {

// Parts of messages beside the numbers of io/bytes.h.

/// Seven bits a byte, the lowest first; the eighth says that more follow.
void appendCount(std::string& bytes, std::uint64_t value);
std::uint64_t readCount(ByteReader& reader);

/// Its number of bytes as a count, then the bytes.
void appendText(std::string_view text, std::string& bytes);
/// Whether there was one.
bool readText(ByteReader& reader, std::string& text);

}  // namespace mrose
