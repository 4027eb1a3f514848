#include "io/pending_file.h"

#include <fcntl.h>

#include "io/system_file.h"

namespace mrose {
namespace {

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

}  // namespace

PendingFile::PendingFile(const std::filesystem::path& path)
    : path_(path), target_(targetOf(path)), beside_(target_.string() + ".part") {}

PendingFile::~PendingFile() {
    if (pending_) ::unlink(beside_.c_str());
}

Expected<void> PendingFile::write(std::string_view content) {
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

Expected<void> PendingFile::replace() {
    if (::rename(beside_.c_str(), target_.c_str()) != 0) return systemFailure();
    pending_ = false;
    return {};
}

tl::unexpected<Error> PendingFile::systemFailure() const {
    return fail(path_.string(), systemCause("cannot be written"));
}

}  // namespace mrose
