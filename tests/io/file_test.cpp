#include "io/file.h"

#include <csignal>
#include <functional>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

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

// Published values of XXH3-64 with seed 0.
TEST(ContentHash, IsXxh3) {
    EXPECT_EQ(contentHash(""), "2d06800538d394c2");
    EXPECT_EQ(contentHash(std::string_view("\0", 1)), "c44bdff4074eecdb");
    EXPECT_EQ(contentHash("a"), "e6c632b61e964e1f");
    EXPECT_EQ(contentHash("abc"), "78af5f94892f3950");
}

}  // namespace
}  // namespace mrose
