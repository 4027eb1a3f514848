#include "io/file_lock.h"

#include <csignal>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/temporary_folder.h"

namespace mrose {
namespace {

/// A file that is open for writing.
class Opened {
public:
    explicit Opened(const std::filesystem::path& path) : descriptor_(::open(path.c_str(), O_RDWR | O_CLOEXEC)) {}
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;
    ~Opened() { ::close(descriptor_); }
    int value() const { return descriptor_; }

private:
    int descriptor_;
};

TEST(FileLock, FileHasOneWriterForAsLongAsItIsOpen) {
    const TemporaryFolder folder;
    const auto file = folder.write("a", "text");
    EXPECT_EQ(isBeingWritten(file), false);
    {
        const Opened first(file), second(file);
        EXPECT_TRUE(lockForWriting(first.value()));
        EXPECT_FALSE(lockForWriting(second.value()));
        EXPECT_TRUE(lockForWriting(first.value())) << "whose it is already";
        EXPECT_EQ(isBeingWritten(file), true);
        { const Opened third(file); }
        EXPECT_EQ(isBeingWritten(file), true) << "whoever else of the process closes it";
    }
    EXPECT_EQ(isBeingWritten(file), false);
    EXPECT_TRUE(lockForWriting(Opened(file).value()));
    EXPECT_EQ(isBeingWritten(folder.path() / "none"), std::nullopt);
}

TEST(FileLock, GoesWithAProcessThatIsKilled) {
    const TemporaryFolder folder;
    const auto file = folder.write("a", "text");
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const Opened held(file);
        const char done = lockForWriting(held.value()) ? 'y' : 'n';
        if (::write(ready[1], &done, 1) == 1) ::pause();
        ::_exit(0);
    }
    char said = 0;
    ASSERT_EQ(::read(ready[0], &said, 1), 1);
    EXPECT_EQ(said, 'y');
    EXPECT_EQ(isBeingWritten(file), true);
    ::kill(child, SIGKILL);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    EXPECT_EQ(isBeingWritten(file), false);
    EXPECT_TRUE(lockForWriting(Opened(file).value()));
    for (const int end : ready) ::close(end);
}

TEST(FileLock, FileThatWasReplacedIsNotAtItsPlaceAnyMore) {
    const TemporaryFolder folder;
    const auto file = folder.write("a", "text"), other = folder.write("b", "other");
    const Opened opened(file);
    EXPECT_TRUE(isFileAt(opened.value(), file));
    EXPECT_FALSE(isFileAt(opened.value(), other));
    std::filesystem::rename(other, file);
    EXPECT_FALSE(isFileAt(opened.value(), file));
    std::filesystem::remove(file);
    EXPECT_FALSE(isFileAt(opened.value(), file));
}

}  // namespace
}  // namespace mrose
