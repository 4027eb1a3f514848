#include "recording/output_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/file.h"
#include "io/file_lock.h"
#include "io/pending_file.h"
#include "recording/crc32.h"

namespace mrose {
namespace {

constexpr int mostTries = 100;

std::string systemCause(const char* what, int error) { return std::string(what) + ": " + std::strerror(error); }

}  // namespace

Expected<OutputFile> OutputFile::create(const std::filesystem::path& path, bool overwrite) {
    Expected<OutputFile> file = open(path, overwrite);
    // It may have been removed or replaced before it was locked.
    for (int i = 0; i < mostTries && file && !isFileAt(file->descriptor_, path); ++i) file = open(path, overwrite);
    if (!file) return file;
    if (::ftruncate(file->descriptor_, 0) != 0) return fail(path.string(), systemCause("cannot be written", errno));
    syncFolderOf(path);
    return file;
}

/// A file that is there is emptied only after it has turned out to be one that may be, and that no other process
/// writes.
Expected<OutputFile> OutputFile::open(const std::filesystem::path& path, bool overwrite) {
    const std::string name = path.string();
    const int exclusive = overwrite ? 0 : O_EXCL;
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK | exclusive, 0666);
    struct stat status {};
    if (descriptor < 0 && errno == EEXIST && ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode))
        return fail(name, notOverwritten);
    if (descriptor < 0 && errno == EEXIST) return fail(name, "is no regular file; expected a name for one");
    if (descriptor < 0) return fail(name, systemCause("cannot be written", errno));
    OutputFile file(descriptor, name);
    if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode))
        return fail(name, "is no regular file; expected a name for one");
    if (!lockForWriting(descriptor)) return fail(name, beingWritten);
    return file;
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      name_(std::move(other.name_)),
      size_(other.size_),
      crc_(other.crc_),
      state_(std::move(other.state_)) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(name_, other.name_);
    std::swap(size_, other.size_);
    std::swap(crc_, other.crc_);
    std::swap(state_, other.state_);
    return *this;
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::failWith(const char* what) {
    state_ = fail(name_, systemCause(what, errno));
    // What cannot be cut off either is a record that readers find to be cut short.
    if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) return;
}

void OutputFile::write(std::string_view bytes) {
    if (!state_) return;
    for (std::string_view rest = bytes; !rest.empty();) {
        const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return failWith("cannot be written");
        rest.remove_prefix(static_cast<std::size_t>(written));
    }
    size_ += bytes.size();
    crc_ = crc32(bytes, crc_);
}

void OutputFile::sync() {
    if (state_ && ::fdatasync(descriptor_) != 0) failWith("cannot be written");
    if (state_) checkPlace();
}

/// Neither who removes, moves or replaces an open file notices it, nor who writes it.
void OutputFile::checkPlace() {
    struct stat open {
    }, there{};
    if (::fstat(descriptor_, &open) != 0) return;
    const bool found = ::stat(name_.c_str(), &there) == 0;
    if (!found && errno != ENOENT && errno != ENOTDIR) return;
    if (found && open.st_dev == there.st_dev && open.st_ino == there.st_ino) return;
    state_ = fail(name_, std::string(found                ? "is another file now: it was replaced"
                                     : open.st_nlink == 0 ? "is no longer there: it was removed"
                                                          : "is no longer there: it was moved") +
                             " while it was written");
}

void OutputFile::discard() {
    if (descriptor_ < 0) return;
    if (isFileAt(descriptor_, name_)) ::unlink(name_.c_str());
    ::close(std::exchange(descriptor_, -1));
}

Expected<void> OutputFile::close() {
    if (descriptor_ < 0) return state_;
    sync();
    if (::close(std::exchange(descriptor_, -1)) != 0 && state_)
        state_ = fail(name_, systemCause("cannot be written", errno));
    return state_;
}

}  // namespace mrose
