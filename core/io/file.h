#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "io/error.h"

namespace mrose {

/// Half of this computer's memory: what is larger is not read, nor what a file holds compressed unpacked beyond it.
std::uint64_t mostBytesRead();

/// The whole content of a regular file. Error: missing, a directory, unreadable, larger than mostBytesRead().
Expected<std::string> readFile(const std::filesystem::path& path);

/// Replaces `path` in one go: the content is written beside it, synced and renamed, so that a full disk, a crash or a
/// kill leaves either the old file or the new one. Parent folders must exist. Error: what the system says. What becomes
/// of links, modes and files that are no regular ones says PendingFile.
Expected<void> writeFileAtomically(const std::filesystem::path& path, std::string_view content);

/// Several files that belong together: all of them are written before the first replaces its old one, so that a full
/// disk leaves all the old ones.
struct NamedFile {
    std::filesystem::path path;
    std::string content;
};
Expected<void> writeFilesAtomically(std::span<const NamedFile> files);

/// Error unless a file could be written at `path`; lets long work fail at its start and not at its end. Without
/// `overwrite` a file that is there already is an error too. Nothing is changed, and nothing stays.
Expected<void> checkWritable(const std::filesystem::path& path, bool overwrite = true);

/// What is said of a file that is there already.
constexpr const char* notOverwritten = "is there already; --overwrite replaces it";

/// XXH3 of the bytes, 16 hexadecimal digits.
std::string contentHash(std::string_view bytes);

}  // namespace mrose
