#include "io/file.h"

#include <deque>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>
#include <xxhash.h>

#include "io/format.h"
#include "io/pending_file.h"
#include "io/system_file.h"

namespace mrose {

std::uint64_t mostBytesRead() {
    return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
           static_cast<std::uint64_t>(::sysconf(_SC_PAGE_SIZE)) / 2;
}

Expected<std::string> readFile(const std::filesystem::path& path) {
    FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.value() < 0) return fail(path.string(), systemCause("cannot be read"));
    std::error_code ignored;
    // A device may never end.
    const auto type = std::filesystem::status(path, ignored).type();
    if (type == std::filesystem::file_type::character || type == std::filesystem::file_type::block)
        return fail(path.string(), "is a device; expected a file");
    const auto tooLarge = [&](std::uint64_t size) {
        return fail(path.string(),
                    "has " + std::to_string(size >> 20) + " MB or more: more than half of this computer's memory");
    };
    std::string content;
    if (const auto size = std::filesystem::file_size(path, ignored); !ignored) {
        if (size > mostBytesRead()) return tooLarge(size);
        content.reserve(size + 1);
    }
    for (;;) {
        const std::size_t old = content.size();
        if (old > mostBytesRead()) return tooLarge(old);
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
    if (auto writable = PendingFile(path).check(); !writable) return writable;
    std::error_code ignored;
    if (!overwrite && std::filesystem::exists(path, ignored)) return fail(path.string(), notOverwritten);
    return {};
}

std::string contentHash(std::string_view bytes) { return hexadecimal(XXH3_64bits(bytes.data(), bytes.size())); }

}  // namespace mrose
