#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "io/bytes.h"

namespace mrose::mcap {

// The container format MCAP, version 0, as published at mcap.dev/spec: a magic text, records, the magic text again.
// Every record is its kind (1 byte), the length of its content (8 bytes) and the content.

constexpr std::string_view magic{"\x89MCAP0\r\n", 8};
constexpr std::size_t recordHead = 9;

enum class Kind : std::uint8_t {
    header = 1,
    footer,
    schema,
    channel,
    message,
    chunk,
    messageIndex,
    chunkIndex,
    attachment,
    attachmentIndex,
    statistics,
    metadata,
    metadataIndex,
    summaryOffset,
    dataEnd,
};

using Strings = std::map<std::string, std::string>;

inline void appendText(std::string& bytes, std::string_view text) {
    appendNumber(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += text;
}

inline void appendRecord(std::string& bytes, Kind kind, std::string_view content) {
    appendNumber(bytes, kind);
    appendNumber(bytes, std::uint64_t{content.size()});
    bytes += content;
}

void appendStrings(std::string& bytes, const Strings& strings);

inline std::string_view readText(ByteReader& reader) { return reader.take(reader.number<std::uint32_t>()); }
Strings readStrings(ByteReader& reader);

}  // namespace mrose::mcap
