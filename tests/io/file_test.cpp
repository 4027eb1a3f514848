#include "io/file.h"

#include <csignal>
#include <functional>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/file_lock.h"
#include "io/pending_file.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

/// Runs `body` in a child in which no file may grow beyond `bytes`, as on a disk that is full; its result.
int onFullDisk(rlim_t bytes, const std::function<int()>& body) {
    const pid_t child = ::fork();
    if (child == 0) {
        const rlimit limit{bytes, bytes};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        ::signal(SIGXFSZ, SIG_IGN);
        ::_exit(body());
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::size_t filesIn(const TemporaryFolder& folder) {
    const std::filesystem::directory_iterator files(folder.path());
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

TEST(File, ComesBackByteForByte) {
    const TemporaryFolder folder;
    std::string content(300'000, 'x');
    for (std::size_t i = 0; i < content.size(); ++i) content[i] = static_cast<char>(i * i >> 7);
    for (const std::string& written : {content, std::string(), std::string("\0\n\r\n", 4)}) {
        ASSERT_TRUE(writeFileAtomically(folder.path() / "a", written));
        EXPECT_EQ(readFile(folder.path() / "a"), written);
    }
    EXPECT_EQ(filesIn(folder), 1u);
}

TEST(File, WhatCannotBeReadSaysWhy) {
    const TemporaryFolder folder;
    const std::string missing = (folder.path() / "missing").string();
    EXPECT_EQ(readFile(missing).error().message(), missing + ": cannot be read: No such file or directory");
    EXPECT_EQ(readFile(folder.path()).error().message(), folder.path().string() + ": cannot be read: Is a directory");
}

TEST(File, WhatHasNoSizeIsReadToItsEnd) {
    const auto status = readFile("/proc/self/status");
    ASSERT_TRUE(status);
    EXPECT_NE(status->find("Threads:"), std::string::npos);
}

/// Holes take no room on the disk.
TEST(File, WhatTheMemoryCannotHoldIsNotRead) {
    const TemporaryFolder folder;
    const auto file = folder.write("huge", "x");
    std::filesystem::resize_file(file, std::uintmax_t{1} << 42);
    const auto read = readFile(file);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message(),
              file.string() + ": has 4194304 MB or more: more than half of this computer's memory");
}

TEST(File, PlacesThatCannotBeWrittenAreRefusedByCheckAndWrite) {
    const TemporaryFolder folder;
    folder.write("plain", "text");
    ::mkfifo((folder.path() / "pipe").c_str(), 0600);
    for (const auto& [name, cause] :
         {std::pair{"no/file", "cannot be written: No such file or directory"},
          std::pair{".", "is a folder; expected a file"}, std::pair{"plain/file", "cannot be written: Not a directory"},
          std::pair{"pipe", "is no regular file; expected a name that can be replaced"}}) {
        const std::filesystem::path path = folder.path() / name;
        EXPECT_EQ(checkWritable(path).error().message(), path.string() + ": " + cause);
        EXPECT_EQ(writeFileAtomically(path, "new").error().message(), path.string() + ": " + cause);
    }
    EXPECT_EQ(filesIn(folder), 2u);
}

TEST(File, CheckChangesNothing) {
    const TemporaryFolder folder;
    const auto old = folder.write("old", "content");
    EXPECT_TRUE(checkWritable(old));
    EXPECT_TRUE(checkWritable(folder.path() / "new"));
    EXPECT_EQ(readFile(old), "content");
    EXPECT_EQ(filesIn(folder), 1u);
}

TEST(File, FullDiskKeepsTheOldContentAndNoHalfFile) {
    const TemporaryFolder folder;
    const auto file = folder.write("a", "old");
    const int result = onFullDisk(1000, [&] {
        const auto written = writeFileAtomically(file, std::string(5000, 'x'));
        return written ? 1 : written.error().cause == "cannot be written: File too large" ? 42 : 2;
    });
    EXPECT_EQ(result, 42);
    EXPECT_EQ(readFile(file), "old");
    EXPECT_EQ(filesIn(folder), 1u);
}

TEST(File, FilesThatBelongTogetherAreReplacedTogether) {
    const TemporaryFolder folder;
    const NamedFile files[] = {{folder.write("a", "old a"), "new a"},
                               {folder.write("b", "old b"), std::string(5000, 'x')},
                               {folder.path() / "c", "new c"}};
    EXPECT_EQ(onFullDisk(1000, [&] { return writeFilesAtomically(files) ? 1 : 42; }), 42);
    EXPECT_EQ(readFile(folder.path() / "a"), "old a");
    EXPECT_EQ(readFile(folder.path() / "b"), "old b");
    EXPECT_EQ(filesIn(folder), 2u);
    ASSERT_TRUE(writeFilesAtomically(files));
    for (const NamedFile& file : files) EXPECT_EQ(readFile(file.path), file.content);
    EXPECT_EQ(filesIn(folder), 3u);
}

TEST(File, SymbolicLinkStaysOne) {
    const TemporaryFolder folder;
    folder.write("kept/real", "old");
    std::filesystem::create_symlink("kept/real", folder.path() / "link");
    std::filesystem::create_symlink("kept/none", folder.path() / "dangling");
    ASSERT_TRUE(writeFileAtomically(folder.path() / "link", "new"));
    ASSERT_TRUE(writeFileAtomically(folder.path() / "dangling", "made"));
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link"));
    EXPECT_EQ(readFile(folder.path() / "kept/real"), "new");
    EXPECT_EQ(readFile(folder.path() / "kept/none"), "made");
}

TEST(File, WhatOthersCallAPartStaysTheirs) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "a", part = folder.write("a.part", "somebody's");
    EXPECT_TRUE(checkWritable(file));
    EXPECT_TRUE(writeFileAtomically(file, "new"));
    EXPECT_EQ(onFullDisk(100, [&] { return writeFileAtomically(file, std::string(5000, 'x')) ? 1 : 42; }), 42);
    EXPECT_EQ(readFile(part), "somebody's");
    EXPECT_EQ(readFile(file), "new");
    EXPECT_EQ(filesIn(folder), 2u);
}

TEST(File, ManyMayWriteOneAtOnce) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "a";
    std::vector<std::string> errors(6);
    std::vector<std::thread> writers;
    for (std::size_t i = 0; i < errors.size(); ++i)
        writers.emplace_back([&, i] {
            for (int k = 0; k < 30; ++k) {
                if (auto can = checkWritable(file); !can) errors[i] = can.error().message();
                const std::string content(20'000, static_cast<char>('a' + i));
                if (auto done = writeFileAtomically(file, content); !done) errors[i] = done.error().message();
            }
        });
    for (std::thread& writer : writers) writer.join();
    for (const std::string& error : errors) EXPECT_EQ(error, "");
    const std::string content = readFile(file).value_or("");
    EXPECT_EQ(content, std::string(20'000, content.empty() ? ' ' : content[0]));
    EXPECT_EQ(filesIn(folder), 1u);
}

TEST(File, KeepsItsModeAndANewOneHasTheUsers) {
    const TemporaryFolder folder;
    const auto modeOf = [](const std::filesystem::path& path) { return std::filesystem::status(path).permissions(); };
    for (const auto mode : {0600, 0640, 0755, 0444}) {
        const auto file = folder.write("a" + std::to_string(mode), "old");
        std::filesystem::permissions(file, std::filesystem::perms(mode));
        ASSERT_TRUE(checkWritable(file));
        ASSERT_TRUE(writeFileAtomically(file, "new"));
        EXPECT_EQ(modeOf(file), std::filesystem::perms(mode));
        EXPECT_EQ(readFile(file), "new");
    }
    for (const auto mask : {027, 0002}) {
        const mode_t before = ::umask(static_cast<mode_t>(mask));
        const auto written = writeFileAtomically(folder.path() / "new", "");
        ::umask(before);
        ASSERT_TRUE(written);
        EXPECT_EQ(modeOf(folder.path() / "new"), std::filesystem::perms(0666 & ~mask));
        std::filesystem::remove(folder.path() / "new");
    }
}

/// Until it is in its place no other user can read what will become a private file.
TEST(File, WhatReplacesAPrivateFileIsPrivateFromTheBeginning) {
    const TemporaryFolder folder;
    const auto file = folder.write("a", "old");
    std::filesystem::permissions(file, std::filesystem::perms(0600));
    PendingFile pending(file);
    ASSERT_TRUE(pending.write("new"));
    EXPECT_EQ(std::filesystem::status(pending.beside()).permissions(), std::filesystem::perms(0600));
}

TEST(File, KeepsItsOwner) {
    if (::geteuid() != 0) GTEST_SKIP() << "only root gives files away";
    const TemporaryFolder folder;
    const auto file = folder.write("a", "old");
    ASSERT_EQ(::chown(file.c_str(), 12345, 23456), 0);
    ASSERT_TRUE(writeFileAtomically(file, "new"));
    struct stat status {};
    ASSERT_EQ(::stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_uid, 12345u);
    EXPECT_EQ(status.st_gid, 23456u);
}

TEST(File, WhatAKillLeavesIsKnownByItsNameAndHarmsNoOtherFile) {
    const TemporaryFolder folder;
    const auto file = folder.write("a.net", "old");
    const pid_t child = ::fork();
    if (child == 0) {
        PendingFile pending(file);
        if (pending.write("half")) ::kill(::getpid(), SIGKILL);
        ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(readFile(file), "old");
    ASSERT_EQ(filesIn(folder), 2u);
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        const std::string name = entry.path().filename().string();
        if (name == "a.net") continue;
        EXPECT_TRUE(name.starts_with("a.net.") && name.ends_with(".part")) << name;
    }
    EXPECT_TRUE(writeFileAtomically(file, "new"));
    EXPECT_EQ(readFile(file), "new");
    EXPECT_EQ(filesIn(folder), 2u);
}

TEST(File, WhatARunningProgramWritesIsNotReplaced) {
    const TemporaryFolder folder;
    const auto file = folder.write("a", "growing");
    const int held = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
    ASSERT_TRUE(lockForWriting(held));
    const std::string expected = file.string() + ": " + beingWritten;
    EXPECT_EQ(checkWritable(file).error().message(), expected);
    EXPECT_EQ(writeFileAtomically(file, "new").error().message(), expected);
    EXPECT_EQ(readFile(file), "growing");
    EXPECT_EQ(filesIn(folder), 1u);
    ::close(held);
    EXPECT_TRUE(writeFileAtomically(file, "new"));
}

/// The longest that the system knows.
TEST(File, LongNamesAreWrittenOrRefusedAtOnce) {
    const TemporaryFolder folder;
    const auto longest = folder.path() / std::string(255, 'n'), longer = folder.path() / std::string(256, 'n');
    EXPECT_TRUE(writeFileAtomically(longest, "new"));
    EXPECT_EQ(readFile(longest), "new");
    EXPECT_EQ(checkWritable(longer).error().cause, "cannot be written: File name too long");
    EXPECT_EQ(filesIn(folder), 1u);
}

// Published values of XXH3-64 with seed 0.
TEST(ContentHash, IsXxh3) {
    EXPECT_EQ(contentHash(""), "2d06800538d394c2");
    EXPECT_EQ(contentHash(std::string_view("\0", 1)), "c44bdff4074eecdb");
    EXPECT_EQ(contentHash("a"), "e6c632b61e964e1f");
    EXPECT_EQ(contentHash("abc"), "78af5f94892f3950");
}

}  // namespace
}  // namespace mrose
