#include "recording/mcap_walk.h"

#include <cstring>
#include <map>

#include <zstd.h>

namespace mrose {
namespace {

template <class Number>
Number numberAt(std::string_view bytes, std::size_t offset) {
    Number value{};
    if (offset + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

std::vector<WalkedRecord> recordsFrom(std::string_view bytes, std::size_t at) {
    std::vector<WalkedRecord> records;
    while (at + 9 <= bytes.size()) {
        const auto length = numberAt<std::uint64_t>(bytes, at + 1);
        if (length > bytes.size() - at - 9) break;
        records.push_back({static_cast<std::uint8_t>(bytes[at]), at, at + 9 + length, bytes.substr(at + 9, length)});
        at += 9 + length;
    }
    return records;
}

std::string unpacked(std::string_view chunk) {
    const auto size = numberAt<std::uint64_t>(chunk, 16);
    const auto name = numberAt<std::uint32_t>(chunk, 28);
    const std::string_view packed = chunk.substr(32 + name + 8);
    std::string records(size, '\0');
    ZSTD_decompress(records.data(), size, packed.data(), packed.size());
    return records;
}

}  // namespace

std::vector<WalkedRecord> walkRecords(std::string_view file) { return recordsFrom(file, 8); }

std::vector<WalkedMessage> walkMessages(std::string_view file) {
    std::map<std::uint16_t, std::string> topics;
    std::vector<WalkedMessage> messages;
    for (const WalkedRecord& record : walkRecords(file)) {
        if (record.kind == 0x0f) break;
        if (record.kind == 0x04) {
            const auto length = numberAt<std::uint32_t>(record.content, 4);
            topics[numberAt<std::uint16_t>(record.content, 0)] = record.content.substr(8, length);
        }
        if (record.kind != 0x06) continue;
        const std::string chunk = unpacked(record.content);
        for (const WalkedRecord& inside : recordsFrom(chunk, 0))
            if (inside.kind == 0x05)
                messages.push_back({topics[numberAt<std::uint16_t>(inside.content, 0)],
                                    numberAt<std::int64_t>(inside.content, 6), std::string(inside.content.substr(22))});
    }
    return messages;
}

std::map<std::string, nlohmann::json> walkSchemas(std::string_view file) {
    std::map<std::uint16_t, nlohmann::json> schemas;
    std::map<std::string, nlohmann::json> topics;
    for (const WalkedRecord& record : walkRecords(file)) {
        const std::string_view content = record.content;
        const auto id = numberAt<std::uint16_t>(content, 0);
        if (record.kind == 0x03) {
            const std::size_t encoding = 6 + numberAt<std::uint32_t>(content, 2);
            const std::size_t text = encoding + 4 + numberAt<std::uint32_t>(content, encoding);
            schemas[id] = nlohmann::json::parse(content.substr(text + 4));
        }
        if (record.kind == 0x04)
            topics[std::string(content.substr(8, numberAt<std::uint32_t>(content, 4)))] =
                schemas[numberAt<std::uint16_t>(content, 2)];
    }
    return topics;
}

}  // namespace mrose
