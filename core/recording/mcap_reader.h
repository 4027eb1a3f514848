#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/error.h"
#include "recording/mcap_format.h"

namespace mrose::mcap {

struct Attachment {
    std::string_view name, mediaType, data;
    std::int64_t time = 0;
    std::uint64_t offset = 0;  ///< of its record in the file
};

/// What an MCAP file holds besides its messages, in the file's order. Views look into the file's bytes.
struct Content {
    std::vector<Attachment> attachments;
    std::vector<std::pair<std::string, Strings>> metadata;
    /// What is wrong with the file and where, a sentence each; empty: it is whole. Nothing is read from behind a record
    /// that is cut short or an attachment whose CRC does not fit; chunks are only checked.
    std::vector<std::string> damage;
    bool endless = false;  ///< its end is missing: it was cut off, or is still being written; this is damage, too
};

/// Error: the bytes do not begin as an MCAP file does.
Expected<Content> parse(std::string_view bytes, const std::string& name);

}  // namespace mrose::mcap
