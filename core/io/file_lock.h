#pragma once

#include <filesystem>
#include <optional>

namespace mrose {

// A file that is written for long is locked, so that it has one writer. A lock is the open file's, and goes with its
// process however that ends. Where a file system has no locks, writers are not kept apart.

/// Of a file that is open for writing. False: it has a writer already.
bool lockForWriting(int descriptor);

/// Whether a file has such a writer, in any process; looking changes nothing. nullopt: the system does not say.
std::optional<bool> isBeingWritten(const std::filesystem::path& path);
constexpr const char* beingWritten = "is being written by a running program; expected another name";

/// Whether the file that is open is still the one at `path`: a lock that was waited for may be that of a file that was
/// removed or replaced meanwhile.
bool isFileAt(int descriptor, const std::filesystem::path& path);

}  // namespace mrose
