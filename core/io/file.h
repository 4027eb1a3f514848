#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/error.h"

namespace mrose {

/// The whole content of a regular file. Error: missing, a directory, unreadable.
Expected<std::string> readFile(const std::filesystem::path& path);

/// Replaces `path` in one go: the content is written beside it, synced and renamed, so that a full disk, a crash or a
/// kill leaves either the old file or the new one. Parent folders must exist. Error: what the system says.
Expected<void> writeFileAtomically(const std::filesystem::path& path, std::string_view content);

/// Error unless a file could be written at `path`; lets long work fail at its start and not at its end.
Expected<void> checkWritable(const std::filesystem::path& path);

/// XXH3 of the bytes, 16 hexadecimal digits.
std::string contentHash(std::string_view bytes);

}  // namespace mrose
