#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "support/places.h"

namespace mrose {

/// The folder of real logs: the environment variable MROSE_DATA, otherwise ../shared/data beside the repository's root.
/// nullopt where neither is a folder; tests then skip and say so.
inline std::optional<std::filesystem::path> realData() {
    const char* const named = std::getenv("MROSE_DATA");
    const std::filesystem::path folder = named != nullptr ? named : sourceFolder().parent_path() / "shared" / "data";
    if (!std::filesystem::is_directory(folder)) return std::nullopt;
    return folder;
}

}  // namespace mrose
