// The program records: what a kill and a full disk leave.
#include <csignal>
#include <filesystem>

#include <gtest/gtest.h>
#include <unistd.h>

#include "recording/recording.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

/// False: it did not come true while a program could be expected to run.
template <class Condition>
bool waitUntil(Condition condition) {
    for (int i = 0; i < 300'000; ++i) {
        if (condition()) return true;
        ::usleep(1000);
    }
    return false;
}

class RecordedRun : public testing::Test {
protected:
    std::vector<std::string> words(const std::string& speed, const std::string& duration) const {
        return {mroseProgram(), "run",      "soccer.toml", "--speed",     speed,    "--duration",
                duration,       "--record", path_,         "--overwrite", "--quiet"};
    }
    /// Bytes so far; 0 where there is no file yet.
    std::uintmax_t size() const {
        std::error_code missing;
        const std::uintmax_t found = std::filesystem::file_size(path_, missing);
        return missing ? 0 : found;
    }
    /// The last tick that can be reached; -1 while there is no beginning.
    std::int64_t lastTick() const {
        const auto recording = openRecording(path_);
        return recording ? recording->branches[0].timeline.last() : -1;
    }
    /// Ticks between parts of the file that are written without being asked for.
    std::int64_t keyframeInterval() const {
        const auto recording = openRecording(path_);
        if (!recording) return 0;
        const auto& blocks = recording->branches[0].timeline.blocks();
        return blocks.size() < 3 ? 0 : blocks[2].first - blocks[1].first;
    }
    /// It opens with one sentence on where it was cut off, and its `ticks` are what the same scenario does again.
    void expectCutOffAndSame(std::int64_t ticks) const {
        const auto recording = openRecording(path_);
        ASSERT_TRUE(recording) << recording.error().message();
        ASSERT_EQ(recording->damage.size(), 1u);
        EXPECT_TRUE(recording->damage[0].starts_with("it is cut off at byte ") ||
                    recording->damage[0].starts_with("its end is missing"))
            << recording->damage[0];
        for (const char* how : {"", "--decide"}) {
            const ProgramResult replayed =
                runMrose(*how == 0 ? std::vector<std::string>{"replay", path_, "--quiet"}
                                   : std::vector<std::string>{"replay", path_, "--quiet", how});
            EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
            EXPECT_TRUE(replayed.out.starts_with(std::to_string(ticks) + " ticks replayed")) << replayed.out;
            EXPECT_TRUE(replayed.err.starts_with("mrose: " + path_ + ": " + recording->damage[0] +
                                                 "; kept: " + std::to_string(ticks) + " tick"))
                << replayed.err;
        }
    }

    TemporaryFolder folder_;
    std::string path_ = (folder_.path() / "game.mcap").string();
};

/// Killed wherever it is in writing.
TEST_F(RecordedRun, KillAtAnyMomentLeavesWhatWasWritten) {
    for (int i = 1; i <= 8; ++i) {
        std::filesystem::remove(path_);
        RunningProgram program(words("0", "100000"));
        const std::uintmax_t enough = std::uintmax_t(i) * 77777;
        ASSERT_TRUE(waitUntil([&] { return size() >= enough; }));
        const std::int64_t before = lastTick();
        program.send(SIGKILL);
        EXPECT_EQ(program.finish().status, 128 + SIGKILL);
        const std::int64_t ticks = lastTick();
        EXPECT_GE(ticks, before);
        EXPECT_GT(ticks, 0);
        expectCutOffAndSame(ticks);
    }
}

/// A run that takes its time does not wait until a keyframe is due, which here would be after more than a minute.
TEST_F(RecordedRun, SlowRunIsWrittenAsItGoes) {
    ASSERT_EQ(RunningProgram(words("0", "60")).finish().status, 0);
    const std::int64_t interval = keyframeInterval();
    ASSERT_GT(interval, 300);
    std::filesystem::remove(path_);
    RunningProgram program(words("0.1", "60"));
    ASSERT_TRUE(waitUntil([&] { return lastTick() >= 2; }));
    program.send(SIGKILL);
    EXPECT_EQ(program.finish().status, 128 + SIGKILL);
    const std::int64_t ticks = lastTick();
    EXPECT_LT(ticks, interval);
    expectCutOffAndSame(ticks);
}

/// One line says so when it happens; the run goes on to its end, and what was written stays.
TEST_F(RecordedRun, FullDiskIsSaidOnceAndKeepsWhatWasWritten) {
    ASSERT_EQ(RunningProgram(words("0", "300")).finish().status, 0);
    const std::uintmax_t whole = size();
    const std::int64_t all = lastTick();
    for (const std::uintmax_t share : {10, 3, 2}) {
        std::vector<std::string> limited{"/bin/sh", "-c", "trap '' XFSZ; ulimit -f \"$0\"; exec \"$@\"",
                                         std::to_string(whole / share / 512)};
        for (const std::string& word : words("0", "300")) limited.push_back(word);
        const ProgramResult result = RunningProgram(limited).finish();
        EXPECT_EQ(result.status, 1);
        EXPECT_EQ(result.err, "mrose: " + path_ +
                                  ": cannot be written: File too large; the run goes on, and its recording ends "
                                  "here\n");
        EXPECT_NE(result.out.find("300.00 s"), std::string::npos) << result.out;
        EXPECT_LE(size(), whole / share);
        const std::int64_t ticks = lastTick();
        EXPECT_GT(ticks, 0);
        EXPECT_LT(ticks, all);
        expectCutOffAndSame(ticks);
    }
}

}  // namespace
}  // namespace mrose
