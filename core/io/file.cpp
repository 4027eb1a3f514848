#include "io/file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
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

}  // namespace

Expected<std::string> readFile(const std::filesystem::path& path) {
    FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.value() < 0) return fail(path.string(), systemCause("cannot be read"));
    std::error_code ignored;
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
    const std::filesystem::path beside = path.string() + ".part";
    FileDescriptor file(::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
    if (file.value() < 0) return fail(path.string(), systemCause("cannot be written"));
    const bool written = writeAll(file.value(), content) && ::fsync(file.value()) == 0 && file.close() &&
                         ::rename(beside.c_str(), path.c_str()) == 0;
    if (written) return {};
    auto failure = fail(path.string(), systemCause("cannot be written"));
    ::unlink(beside.c_str());
    return failure;
}

Expected<void> checkWritable(const std::filesystem::path& path) {
    if (std::filesystem::is_directory(path)) return fail(path.string(), "is a folder; expected the name of a file");
    const std::filesystem::path beside = path.string() + ".part";
    FileDescriptor file(::open(beside.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644));
    if (file.value() < 0) return fail(path.string(), systemCause("cannot be written"));
    ::unlink(beside.c_str());
    return {};
}

std::string contentHash(std::string_view bytes) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx",
                  static_cast<unsigned long long>(XXH3_64bits(bytes.data(), bytes.size())));
    return text;
}

}  // namespace mrose
