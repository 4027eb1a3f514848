#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace mrose {

/// A record of an MCAP file, read without the code that is tested.
struct WalkedRecord {
    std::uint8_t kind = 0;
    std::size_t offset = 0, end = 0;  ///< in the file, head included
    std::string_view content;
};
std::vector<WalkedRecord> walkRecords(std::string_view file);

struct WalkedMessage {
    std::string topic;
    std::int64_t time = 0;
    std::string json;
};
/// All messages of all chunks.
std::vector<WalkedMessage> walkMessages(std::string_view file);

/// The schema of each topic.
std::map<std::string, nlohmann::json> walkSchemas(std::string_view file);

}  // namespace mrose
