#include "io/file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <deque>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>
#include <xxhash.h>

namespace mrose {
namespace {

class FileDescriptor {
public:
    explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;
    ~FileDescriptor() { close(); }

    int value() const { return descriptor_; }
    bool close() {
        if (descriptor_ < 0) return true;
        const int result = ::close(descriptor_);
        descriptor_ = -1;
        return result == 0;
    }

private:
    int descriptor_;
};

std::string systemCause(const char* what) { return std::string(what) + ": " + std::strerror(errno); }

bool writeAll(int descriptor, std::string_view content) {
    while (!content.empty()) {
        const ssize_t written = ::write(descriptor, content.data(), content.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        content.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

/// The file that an output's name means: behind symbolic links, so that a link stays one.
std::filesystem::path targetOf(std::filesystem::path path) {
    constexpr int mostLinks = 40;  // the kernel's own bound; a circle of links then cannot be opened
    std::error_code error;
    for (int i = 0; i < mostLinks && std::filesystem::is_symlink(path, error); ++i)
        path = path.parent_path() / std::filesystem::read_symlink(path, error);
    return path;
}

/// An output on its way: written beside its place, and gone again unless it replaces what is there.
class PendingFile {
public:
    explicit PendingFile(const std::filesystem::path& path)
        : path_(path), target_(targetOf(path)), beside_(target_.string() + ".part") {}
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;
    ~PendingFile() {
        if (pending_) ::unlink(beside_.c_str());
    }

    Expected<void> write(std::string_view content) {
        std::error_code ignored;
        const auto status = std::filesystem::status(target_, ignored);
        if (std::filesystem::is_directory(status)) return fail(path_.string(), "is a folder; expected a file");
        // A device or a pipe cannot be replaced, and never should be.
        if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
            return fail(path_.string(), "is no regular file; expected a name that can be replaced");
        FileDescriptor file(::open(beside_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
        if (file.value() < 0) return systemFailure();
        pending_ = true;
        if (!writeAll(file.value(), content) || ::fsync(file.value()) != 0 || !file.close()) return systemFailure();
        return {};
    }

    Expected<void> replace() {
        if (::rename(beside_.c_str(), target_.c_str()) != 0) return systemFailure();
        pending_ = false;
        return {};
    }

private:
    tl::unexpected<Error> systemFailure() const { return fail(path_.string(), systemCause("cannot be written")); }

    std::filesystem::path path_, target_, beside_;
    bool pending_ = false;
};

}  // namespace

Expected<std::string> readFile(const std::filesystem::path& path) {
    FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.value() < 0) return fail(path.string(), systemCause("cannot be read"));
    std::error_code ignored;
    // A device may never end.
    const auto type = std::filesystem::status(path, ignored).type();
    if (type == std::filesystem::file_type::character || type == std::filesystem::file_type::block)
        return fail(path.string(), "is a device; expected a file");
    std::string content;
    if (const auto size = std::filesystem::file_size(path, ignored); !ignored) content.reserve(size + 1);
    for (;;) {
        const std::size_t old = content.size();
        const std::size_t chunk = std::max<std::size_t>(content.capacity() - old, 1 << 16);
        content.resize(old + chunk);
        const ssize_t got = ::read(file.value(), content.data() + old, chunk);
        content.resize(old + (got > 0 ? static_cast<std::size_t>(got) : 0));
        if (got == 0) return content;
        if (got < 0 && errno != EINTR) return fail(path.string(), systemCause("cannot be read"));
    }
}

Expected<void> writeFileAtomically(const std::filesystem::path& path, std::string_view content) {
    const NamedFile file{path, std::string(content)};
    return writeFilesAtomically({&file, 1});
}

Expected<void> writeFilesAtomically(std::span<const NamedFile> files) {
    std::deque<PendingFile> pending;
    for (const NamedFile& file : files) {
        pending.emplace_back(file.path);
        if (auto written = pending.back().write(file.content); !written) return written;
    }
    for (PendingFile& file : pending)
        if (auto replaced = file.replace(); !replaced) return replaced;
    return {};
}

Expected<void> checkWritable(const std::filesystem::path& path, bool overwrite) {
    PendingFile file(path);
    if (auto writable = file.write({}); !writable) return writable;
    std::error_code ignored;
    if (!overwrite && std::filesystem::exists(path, ignored)) return fail(path.string(), notOverwritten);
    return {};
}

std::string contentHash(std::string_view bytes) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx",
                  static_cast<unsigned long long>(XXH3_64bits(bytes.data(), bytes.size())));
    return text;
}

}  // namespace mrose
