#include "io/pending_file.h"

#include <array>

#include <fcntl.h>
#include <sys/stat.h>

#include "io/file_lock.h"
#include "io/system_file.h"

namespace mrose {
namespace {

constexpr int mostTries = 100;

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

std::filesystem::path folderOf(const std::filesystem::path& path) {
    return path.has_parent_path() ? path.parent_path() : ".";
}

}  // namespace

std::filesystem::path nameBeside(const std::filesystem::path& target) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz234567";  // alike where case does not count
    constexpr std::size_t longest = 100;                                      // bytes of the target's own name
    std::array<unsigned char, 8> bytes{};
    if (::getentropy(bytes.data(), bytes.size()) != 0) bytes.fill(0);  // O_EXCL and mkdir() tell apart all the same
    std::string name = target.filename().string().substr(0, longest) + '.';
    for (const unsigned char byte : bytes) name += letters[byte % letters.size()];
    return target.parent_path() / (name + ".part");
}

void syncFolderOf(const std::filesystem::path& path) {
    // A folder that cannot be read, or a file system that cannot do this, is no reason to give up what is written.
    const FileDescriptor folder(::open(folderOf(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.value() >= 0) ::fsync(folder.value());
}

PendingFile::PendingFile(const std::filesystem::path& path) : path_(path), target_(targetOf(path)) {}

PendingFile::~PendingFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!beside_.empty()) ::unlink(beside_.c_str());
}

Expected<void> PendingFile::checkTarget() const {
    struct stat there {};
    if (::stat(target_.c_str(), &there) != 0) {
        if (errno == ENOENT) return {};
        return systemFailure();
    }
    if (S_ISDIR(there.st_mode)) return fail(path_.string(), "is a folder; expected a file");
    // A device or a pipe cannot be replaced, and never should be.
    if (!S_ISREG(there.st_mode))
        return fail(path_.string(), "is no regular file; expected a name that can be replaced");
    if (isBeingWritten(target_).value_or(false)) return fail(path_.string(), beingWritten);
    return {};
}

Expected<void> PendingFile::check() {
    if (auto can = checkTarget(); !can) return can;
    // A file without a name, where the file system knows such.
    const FileDescriptor nameless(::open(folderOf(target_).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600));
    return nameless.value() >= 0 ? Expected<void>() : PendingFile(path_).makeBeside();
}

Expected<void> PendingFile::makeBeside() {
    std::error_code ignored;
    // A private file's new content is never readable by others. A new file's mode is the user's choice.
    const mode_t mode = std::filesystem::exists(target_, ignored) ? 0600 : 0666;
    for (int i = 0; i < mostTries; ++i) {
        const std::filesystem::path name = nameBeside(target_);
        descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
        if (descriptor_ >= 0) beside_ = name;
        if (descriptor_ >= 0 || errno != EEXIST) break;
    }
    return descriptor_ >= 0 ? Expected<void>() : systemFailure();
}

Expected<void> PendingFile::write(std::string_view content) {
    if (auto can = checkTarget(); !can) return can;
    if (auto made = makeBeside(); !made) return made;
    if (!writeAll(descriptor_, content) || ::fsync(descriptor_) != 0) return systemFailure();
    return {};
}

void PendingFile::takeModeAndOwner() const {
    struct stat old {};
    if (::stat(target_.c_str(), &old) != 0) return;
    const bool owned = ::fchown(descriptor_, old.st_uid, old.st_gid) == 0;
    const bool ofItsGroup = owned || ::fchown(descriptor_, static_cast<uid_t>(-1), old.st_gid) == 0;
    mode_t mode = old.st_mode & 0777;
    // Of another group, that one may do no more than anybody.
    if (!ofItsGroup) mode &= ~070U | ((mode & 07U) << 3U);
    // Where there are no modes it stays as it is.
    if (::fchmod(descriptor_, mode) != 0) return;
}

Expected<void> PendingFile::replace() {
    if (auto can = checkTarget(); !can) return can;
    takeModeAndOwner();
    if (::fsync(descriptor_) != 0 || ::rename(beside_.c_str(), target_.c_str()) != 0) return systemFailure();
    beside_.clear();
    syncFolderOf(target_);
    return {};
}

tl::unexpected<Error> PendingFile::systemFailure() const {
    return fail(path_.string(), systemCause("cannot be written"));
}

}  // namespace mrose
