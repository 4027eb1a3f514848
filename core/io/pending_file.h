#pragma once

#include <filesystem>
#include <string_view>

#include "io/error.h"

namespace mrose {

/// An output on its way: written beside its place, and gone again unless it replaces what is there. A symbolic link
/// stays one: the file that it names is replaced. What is no regular file (a folder, a device) is not.
class PendingFile {
public:
    explicit PendingFile(const std::filesystem::path& path);
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;
    ~PendingFile();

    /// Makes the file beside with this content, on the disk.
    Expected<void> write(std::string_view content);
    /// Where it is until it replaces: who has much to write opens this after write().
    const std::filesystem::path& beside() const { return beside_; }
    Expected<void> replace();

private:
    tl::unexpected<Error> systemFailure() const;

    std::filesystem::path path_, target_, beside_;
    bool pending_ = false;
};

}  // namespace mrose
