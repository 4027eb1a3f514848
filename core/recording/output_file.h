#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "io/error.h"

namespace mrose {

/// A file that grows while a program runs and is of use at every moment: what one call writes is in it wholly or not at
/// all, unless the process is killed within the call. After an error it is cut back to the last whole write, and
/// nothing more is written. It has one writer at a time, in whatever process.
class OutputFile {
public:
    /// Error: it exists and `overwrite` is false; it cannot be made; it is no regular file; a running program writes
    /// it, and then it stays as it is.
    static Expected<OutputFile> create(const std::filesystem::path& path, bool overwrite);
    OutputFile(const OutputFile&) = delete;
    OutputFile(OutputFile&& other) noexcept;
    OutputFile& operator=(const OutputFile&) = delete;
    OutputFile& operator=(OutputFile&& other) noexcept;
    ~OutputFile();

    void write(std::string_view bytes);
    /// Waits until the disk has it. An error, too: by its path it is not found any more, because it was removed, moved
    /// or replaced.
    void sync();
    Expected<void> close();  ///< as sync()
    /// Removes it, unless another file has taken its place.
    void discard();

    std::uint64_t size() const { return size_; }
    std::uint32_t crc() const { return crc_; }  ///< of all that was written
    /// The first error.
    const Expected<void>& state() const { return state_; }

private:
    OutputFile(int descriptor, std::string name) : descriptor_(descriptor), name_(std::move(name)) {}
    static Expected<OutputFile> open(const std::filesystem::path& path, bool overwrite);
    void failWith(const char* what);
    void checkPlace();

    int descriptor_ = -1;
    std::string name_;
    std::uint64_t size_ = 0;
    std::uint32_t crc_ = 0;
    Expected<void> state_;
};

}  // namespace mrose
