#pragma once

#include <filesystem>
#include <vector>

#include "io/error.h"

namespace mrose {

/// A folder for outputs, made where it is missing with those above it. What of it is still empty when this object is
/// destroyed is removed again: a failed write leaves nothing behind.
class MadeFolder {
public:
    /// Error: what the system says.
    static Expected<MadeFolder> make(const std::filesystem::path& folder);
    MadeFolder(MadeFolder&&) noexcept = default;
    MadeFolder& operator=(MadeFolder&&) = delete;
    ~MadeFolder();

private:
    MadeFolder() = default;
    std::vector<std::filesystem::path> made_;  ///< the outermost first
};

}  // namespace mrose
