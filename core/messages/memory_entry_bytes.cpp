#include "messages/memory_entry_bytes.h"

#include "messages/text_bytes.h"

namespace mrose {

void appendEntries(const std::vector<MemoryEntry>& entries, std::string& bytes) {
    appendCount(bytes, entries.size());
    for (const MemoryEntry& entry : entries) {
        appendText(entry.name, bytes);
        appendNumber(bytes, entry.value);
        appendText(entry.unit, bytes);
        appendText(entry.text, bytes);
    }
}

bool readEntries(ByteReader& reader, std::vector<MemoryEntry>& entries) {
    for (std::uint64_t left = readCount(reader); left > 0; --left) {
        MemoryEntry entry;
        if (!readText(reader, entry.name)) return false;
        entry.value = reader.number<double>();
        if (!readText(reader, entry.unit) || !readText(reader, entry.text)) return false;
        entries.push_back(std::move(entry));
    }
    return !reader.failed();
}

}  // namespace mrose
