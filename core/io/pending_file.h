#pragma once

#include <filesystem>
#include <string_view>

#include "io/error.h"

namespace mrose {

/// An output while it is written: beside its place, and removed again unless it replaces what is there. A symbolic link
/// stays one: the file that it names is replaced. What is no regular file (a folder, a device) is not, and nor is what
/// a running program writes (io/file_lock.h). The new file has mode and owner of the old one, as far as the system
/// allows.
class PendingFile {
public:
    explicit PendingFile(const std::filesystem::path& path);
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;
    ~PendingFile();

    /// Error unless it could be written; makes nothing that stays.
    Expected<void> check();
    /// Makes the file beside with this content, on the disk; once.
    Expected<void> write(std::string_view content);
    /// Where it is until it replaces, after write(): a writer of much data opens this.
    const std::filesystem::path& beside() const { return beside_; }
    /// All of it on the disk, under its own name.
    Expected<void> replace();

private:
    Expected<void> checkTarget() const;
    Expected<void> makeBeside();
    void takeModeAndOwner() const;
    tl::unexpected<Error> systemFailure() const;

    std::filesystem::path path_, target_, beside_;
    int descriptor_ = -1;  ///< of the file beside
};

/// A name beside a file or folder for what will replace it, as "a.net.k3b9x2qa.part". No other program meets it by
/// chance; what a killed program leaves behind is known by this name and disturbs no other.
std::filesystem::path nameBeside(const std::filesystem::path& target);

/// Waits until the disk knows what the folder of `path` holds.
void syncFolderOf(const std::filesystem::path& path);

}  // namespace mrose
