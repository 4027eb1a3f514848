#include "io/file_lock.h"

#include <fcntl.h>
#include <sys/stat.h>

#include "io/system_file.h"

namespace mrose {
namespace {

/// Of the whole file; of the open file and not of the process (fcntl(2), open file description locks).
struct flock wholeFile() {
    struct flock lock {};
    lock.l_type = F_WRLCK;
    lock.l_whence = SEEK_SET;
    return lock;
}

}  // namespace

bool lockForWriting(int descriptor) {
    struct flock lock = wholeFile();
    return ::fcntl(descriptor, F_OFD_SETLK, &lock) == 0 || (errno != EAGAIN && errno != EACCES);
}

std::optional<bool> isBeingWritten(const std::filesystem::path& path) {
    const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct flock lock = wholeFile();
    if (file.value() < 0 || ::fcntl(file.value(), F_OFD_GETLK, &lock) != 0) return std::nullopt;
    return lock.l_type != F_UNLCK;
}

bool isFileAt(int descriptor, const std::filesystem::path& path) {
    struct stat open {
    }, there{};
    return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &there) == 0 && open.st_dev == there.st_dev &&
           open.st_ino == there.st_ino;
}

}  // namespace mrose
