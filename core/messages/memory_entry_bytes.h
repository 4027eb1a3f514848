#pragma once

#include <string>
#include <vector>

#include "io/bytes.h"
#include "world/memory.h"

namespace mrose {

// What a memory says, as plug-ins' processes tell it. README.md tells the layout.

void appendEntries(const std::vector<MemoryEntry>& entries, std::string& bytes);
/// Whether there were sound ones; nothing is allocated for more than there are bytes for.
bool readEntries(ByteReader& reader, std::vector<MemoryEntry>& entries);

}  // namespace mrose
