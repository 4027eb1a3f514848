#pragma once

#include <string>
#include <string_view>

#include "recording/mcap_reader.h"

namespace mrose {

/// A recording's metadata of that name.
inline mcap::Strings metadataOf(const std::string& file, std::string_view name) {
    const auto content = mcap::parse(file, "");
    for (const auto& [key, strings] : content->metadata)
        if (key == name) return strings;
    return {};
}

/// The same file with other metadata, and without an end: no CRC is left that could tell.
inline std::string withMetadata(const std::string& file, std::string_view name, const mcap::Strings& strings) {
    std::string changed(mcap::magic);
    ByteReader records(std::string_view(file).substr(changed.size()));
    while (!records.rest().empty() && !records.failed()) {
        const mcap::Kind kind{records.number<std::uint8_t>()};
        const std::string_view content = records.take(records.number<std::uint64_t>());
        if (kind == mcap::Kind::dataEnd) break;
        ByteReader reader(content);
        if (kind != mcap::Kind::metadata || mcap::readText(reader) != name) {
            mcap::appendRecord(changed, kind, content);
            continue;
        }
        std::string other;
        mcap::appendText(other, name);
        mcap::appendStrings(other, strings);
        mcap::appendRecord(changed, kind, other);
    }
    return changed;
}

}  // namespace mrose
