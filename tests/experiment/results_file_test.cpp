#include "experiment/results_file.h"

#include <optional>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "io/file.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

class Results : public testing::Test {
protected:
    Expected<ResultsFile> open(const BatchIdentity& identity = {{"--duration", "2.0"}}) const {
        return ResultsFile::open(folder_.path() / "out", identity, "trial,seed,value");
    }
    std::string read(const std::string& name) const { return readFile(folder_.path() / "out" / name).value_or("none"); }
    void write(const std::string& name, const std::string& text) const { folder_.write("out/" + name, text); }

    TemporaryFolder folder_;
};

TEST_F(Results, RowsAreKeptAtOnceAndInOrderAtTheEnd) {
    auto file = open();
    ASSERT_TRUE(file) << file.error().message();
    EXPECT_TRUE(file->add({2, 1}, "2,1,b"));
    EXPECT_TRUE(file->add({10, 3}, "10,3,d"));
    EXPECT_EQ(read("results.part.csv"), "2,1,b\n10,3,d\n");
    EXPECT_EQ(read("results.csv"), "none");
    EXPECT_TRUE(file->add({2, 20}, "2,20,c"));
    EXPECT_TRUE(file->add({1, 9}, "1,9,a"));
    EXPECT_TRUE(file->has({2, 20}));
    EXPECT_FALSE(file->has({20, 2}));
    EXPECT_TRUE(file->finish());
    EXPECT_EQ(read("results.csv"), "trial,seed,value\n1,9,a\n2,1,b\n2,20,c\n10,3,d\n");
    EXPECT_EQ(read("results.part.csv"), "none");
}

TEST_F(Results, OpenedAgainItHasTheRowsOfBefore) {
    {
        auto file = open();
        ASSERT_TRUE(file && file->add({2, 1}, "2,1,b") && file->add({1, 1}, "1,1,a"));
    }
    auto again = open();
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_TRUE(again->has({2, 1}) && again->has({1, 1}));
    EXPECT_EQ(again->rows().size(), 2u);
    EXPECT_TRUE(again->add({3, 1}, "3,1,c"));
    EXPECT_TRUE(again->finish());
    EXPECT_EQ(read("results.csv"), "trial,seed,value\n1,1,a\n2,1,b\n3,1,c\n");
}

/// At whatever byte a kill cuts it off.
TEST_F(Results, RowCutOffIsDroppedAndTheNextBeginsALine) {
    const std::string whole = "1,1,first\n2,1,second\n3,1,third\n";
    for (std::size_t length = 0; length <= whole.size(); ++length) {
        std::filesystem::remove_all(folder_.path() / "out");
        ASSERT_TRUE(open());
        write("results.part.csv", whole.substr(0, length));
        auto file = open();
        ASSERT_TRUE(file) << file.error().message();
        const auto rows =
            static_cast<std::size_t>(std::count(whole.begin(), whole.begin() + static_cast<long>(length), '\n'));
        EXPECT_EQ(file->rows().size(), rows) << length;
        ASSERT_TRUE(file->add({9, 1}, "9,1,last"));
        const std::size_t kept = length == 0 ? 0 : whole.rfind('\n', length - 1) + 1;
        EXPECT_EQ(read("results.part.csv"), whole.substr(0, kept) + "9,1,last\n") << length;
    }
}

/// Killed between results.csv and the end of results.part.csv: no row twice.
TEST_F(Results, RowsInBothFilesCountOnce) {
    {
        auto file = open();
        ASSERT_TRUE(file && file->add({1, 1}, "1,1,a") && file->finish());
    }
    write("results.part.csv", "1,1,a\n");
    auto again = open();
    ASSERT_TRUE(again && again->finish());
    EXPECT_EQ(read("results.csv"), "trial,seed,value\n1,1,a\n");
}

TEST_F(Results, FoldersOfOthersAreRefusedAndLeftAlone) {
    {
        auto file = open();
        ASSERT_TRUE(file && file->add({1, 1}, "1,1,a"));
    }
    const auto other = open({{"--duration", "3.0"}});
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().message(), (folder_.path() / "out").string() +
                                           ": holds other results: --duration was 2.0 and is 3.0; expected "
                                           "an empty folder, or the same batch or experiment");
    EXPECT_EQ(read("batch.txt"), "--duration = 2.0\nend of this file\n");
    EXPECT_EQ(read("results.part.csv"), "1,1,a\n");
    std::filesystem::remove(folder_.path() / "out" / "batch.txt");
    const auto foreign = open();
    ASSERT_FALSE(foreign);
    EXPECT_NE(foreign.error().message().find("holds results of no batch and no experiment; expected an empty folder"),
              std::string::npos);
    EXPECT_EQ(read("batch.txt"), "none");
}

/// Whatever names and values hold.
TEST_F(Results, WhatDiffersIsTold) {
    const BatchIdentity identity{
        {"--until", "a = b\n\\n = c"}, {"content of a = b\n.toml", "1"}, {"scenario", "a.toml"}};
    ASSERT_TRUE(open({{"scenario", "another.toml"}})) << "without a row, which does not bind the folder";
    {
        auto file = open(identity);
        ASSERT_TRUE(file && file->add({1, 1}, "1,1,a"));
    }
    EXPECT_TRUE(open(identity)) << "the same";
    const auto told = [&](const std::string& name, const std::string& value) {
        BatchIdentity other = identity;
        other[name] = value;
        if (value.empty()) other.erase(name);
        const auto refused = open(other);
        return refused ? "" : refused.error().message().substr((folder_.path() / "out").string().size());
    };
    const std::string begin = ": holds other results: ",
                      end = "; expected an empty folder, or the same batch or experiment";
    EXPECT_EQ(told("scenario", "b.toml"), begin + "scenario was a.toml and is b.toml" + end);
    EXPECT_EQ(told("--log", "x"), begin + "--log was not given and is x" + end);
    EXPECT_EQ(told("--until", ""), begin + "--until was a = b?\\n = c and is not given" + end);
    EXPECT_EQ(told("content of a = b\n.toml", "2"), begin + "the content of a = b?.toml has changed" + end);
    EXPECT_EQ(told("content of a = b\n.toml", ""), begin + "they were made with a = b?.toml" + end);
    EXPECT_EQ(told("content of c.so", "2"), begin + "they were made without c.so" + end);
}

/// Another version may know its results by other things: these are no reason.
TEST_F(Results, AnotherVersionIsToldFirst) {
    {
        auto file = open({{"mrose", "0.9.0 abc"}, {"scenario", "a.toml"}});
        ASSERT_TRUE(file && file->add({1, 1}, "1,1,a"));
    }
    const auto refused = open({{"experiment", "lane"}, {"mrose", "1.0.0 def"}});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message().find(
                  ": holds other results: they were made by mrose 0.9.0 abc, and this is 1.0.0 def; expected"),
              std::string::npos)
        << refused.error().message();
}

TEST_F(Results, WhatIsCutOffIsSaidToBeDamaged) {
    const BatchIdentity identity{{"--duration", "2.0"}, {"content of a.toml", "1"}, {"scenario", "a.toml"}};
    {
        auto file = open(identity);
        ASSERT_TRUE(file && file->add({1, 1}, "1,1,a"));
    }
    const std::string whole = read("batch.txt");
    const std::size_t lastLine = whole.rfind("end of this file");
    for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
        if (size == lastLine || size + 1 == lastLine) continue;  // all is said
        folder_.write("out/batch.txt", whole.substr(0, size));
        const auto refused = open(identity);
        ASSERT_FALSE(refused) << size;
        EXPECT_NE(refused.error().message().find("batch.txt: is damaged and does not say any more whose results"),
                  std::string::npos)
            << size << ' ' << refused.error().message();
    }
    folder_.write("out/batch.txt", whole);
    EXPECT_TRUE(open(identity));
}

TEST_F(Results, OneBatchAtATime) {
    auto first = open();
    ASSERT_TRUE(first);
    const auto second = open();
    ASSERT_FALSE(second);
    EXPECT_NE(second.error().message().find("another mrose is at work in it"), std::string::npos);
    EXPECT_TRUE(first->add({1, 1}, "1,1,a"));
    EXPECT_EQ(read("results.part.csv"), "1,1,a\n");
}

/// They all find no batch.txt.
TEST_F(Results, OfManyThatBeginAtOnceOneHasTheFolder) {
    for (int round = 0; round < 40; ++round) {
        std::filesystem::remove_all(folder_.path() / "out");
        std::vector<std::optional<Expected<ResultsFile>>> opened(6);
        std::vector<std::thread> threads;
        for (auto& one : opened) threads.emplace_back([&] { one.emplace(open()); });
        for (std::thread& thread : threads) thread.join();
        std::string errors;
        int holders = 0;
        for (const auto& one : opened)
            if (*one)
                ++holders;
            else if (one->error().cause != "another mrose is at work in it")
                errors += one->error().message() + '\n';
        ASSERT_EQ(errors, "");
        ASSERT_EQ(holders, 1);
        ASSERT_EQ(read("batch.txt"), "--duration = 2.0\nend of this file\n");
    }
}

/// As one who begins when the folder is made for the first time.
TEST_F(Results, FolderOfABatchWithoutARowIsLockedWhileItBecomesAnother) {
    ASSERT_TRUE(open());
    const auto mine = open({{"--duration", "3.0"}});
    ASSERT_TRUE(mine) << mine.error().message();
    EXPECT_EQ(read("batch.txt"), "--duration = 3.0\nend of this file\n");
    EXPECT_FALSE(open({{"--duration", "3.0"}}));
    EXPECT_FALSE(open());
}

TEST_F(Results, PlacesThatCannotBeWrittenAreNamed) {
    folder_.write("out", "a file");
    const auto inTheWay = open();
    ASSERT_FALSE(inTheWay);
    EXPECT_TRUE(inTheWay.error().message().starts_with((folder_.path() / "out").string() + ": "))
        << inTheWay.error().message();
    const auto nowhere = ResultsFile::open("/proc/none/out", {}, "trial,seed");
    ASSERT_FALSE(nowhere);
    EXPECT_TRUE(nowhere.error().message().starts_with("/proc/none/out: ")) << nowhere.error().message();
    if (::geteuid() == 0) return;  // who may write everywhere
    std::filesystem::remove(folder_.path() / "out");
    std::filesystem::create_directory(folder_.path() / "out");
    std::filesystem::permissions(folder_.path() / "out",
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    const auto locked = open();
    std::filesystem::permissions(folder_.path() / "out", std::filesystem::perms::owner_all);
    ASSERT_FALSE(locked);
    EXPECT_NE(locked.error().message().find("Permission denied"), std::string::npos) << locked.error().message();
}

}  // namespace
}  // namespace mrose
