// Recordings whose writing does not go as it should: a full disk, a kill.
#include <csignal>
#include <functional>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/file.h"
#include "recording/playback.h"
#include "recording/recording_fixture.h"
#include "support/full_disk.h"
#include "world/state_difference.h"

namespace mrose {
namespace {

TEST_F(RecordingFile, FullDiskLeavesWhatWasWrittenWhole) {
    const std::uintmax_t whole = std::filesystem::file_size(record());
    std::int64_t last = -1;
    for (std::uintmax_t room = 0; room < whole; room += whole / 37) {
        const std::filesystem::path path = folder.path() / ("full_" + std::to_string(room));
        Expected<void> closed;
        {
            const FullDisk full(room);
            auto writer = RecordingWriter::create(path, scenario, run.states.front(), value, "", {true, 40});
            if (!writer) {
                EXPECT_EQ(last, -1) << "there was room when there was less";
                EXPECT_NE(writer.error().message().find(path.string() + ": cannot be written"), std::string::npos);
                continue;
            }
            for (std::size_t i = 0; i < run.traces.size(); ++i) writer->add(run.states[i + 1], run.traces[i]);
            closed = writer->close();
            EXPECT_EQ(writer->state().has_value(), closed.has_value());
        }
        if (closed) break;  // without the branch there is room for all
        EXPECT_NE(closed.error().message().find("cannot be written"), std::string::npos);
        EXPECT_LE(std::filesystem::file_size(path), room);
        const auto recording = openRecording(path);
        ASSERT_TRUE(recording) << recording.error().message();
        ASSERT_EQ(recording->damage.size(), 1u);
        // Cut back to whole records: it ends where the next record would begin.
        EXPECT_EQ(recording->damage[0], "its end is missing: it is being written, or was not closed");
        const Timeline& timeline = recording->branches[0].timeline;
        EXPECT_GE(timeline.last(), last);
        last = timeline.last();
        EXPECT_FALSE(firstDifference(run.states[static_cast<std::size_t>(last)],
                                     Playback(scenario).reach(timeline, last)->state));
    }
    EXPECT_EQ(last, ticks);
}

TEST_F(RecordingFile, KilledProgramLeavesWhatItFlushed) {
    const std::filesystem::path path = folder.path() / "killed.mcap";
    const pid_t child = ::fork();
    if (child == 0) {
        auto writer = RecordingWriter::create(path, scenario, run.states.front(), value);
        for (std::size_t i = 0; i < 150; ++i) {
            writer->add(run.states[i + 1], run.traces[i]);
            if (i % 50 == 40) writer->flush();
        }
        ::kill(::getpid(), SIGKILL);
        ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    const auto recording = openRecording(path);
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_EQ(recording->damage.size(), 1u);
    EXPECT_EQ(*recording->header.value, *value);
    EXPECT_EQ(recording->branches[0].timeline.last(), 141);
    expectStates(recording->branches[0].timeline, run);
}

TEST_F(RecordingFile, FileThatIsNotAtItsPlaceAnyMoreIsAnErrorAtTheNextFlush) {
    const std::filesystem::path moved = folder.path() / "moved.mcap";
    const auto removes = [](const auto& path) { std::filesystem::remove(path); };
    const auto moves = [&](const auto& path) { std::filesystem::rename(path, moved); };
    const auto replaces = [&](const auto& path) { std::filesystem::copy_file(moved, path); };
    const std::vector<std::pair<std::function<void(const std::filesystem::path&)>, std::string>> cases{
        {removes, "is no longer there: it was removed while it was written"},
        {moves, "is no longer there: it was moved while it was written"},
        {[&](const auto& path) { removes(path), replaces(path); }, "is another file now: it was replaced"}};
    for (const auto& [does, says] : cases)
        for (const bool flushes : {true, false}) {
            const std::filesystem::path path = folder.path() / "run.mcap";
            auto writer = RecordingWriter::create(path, scenario, run.states.front(), value, "", {true});
            ASSERT_TRUE(writer) << writer.error().message();
            for (std::size_t i = 0; i < 60; ++i) writer->add(run.states[i + 1], run.traces[i]);
            writer->flush();
            ASSERT_TRUE(writer->state());
            does(path);
            if (flushes) writer->flush();
            EXPECT_EQ(writer->state().has_value(), !flushes);
            const auto closed = writer->close();
            ASSERT_FALSE(closed) << says;
            EXPECT_NE(closed.error().message().find(path.string() + ": " + says), std::string::npos)
                << closed.error().message();
        }
    // What was moved goes as far as it was written.
    EXPECT_EQ(openRecording(moved)->branches[0].timeline.last(), 60);
}

TEST_F(RecordingFile, SecondWriterIsRefusedAndTheFirstGoesOn) {
    const std::filesystem::path path = folder.path() / "run.mcap";
    {
        auto first = RecordingWriter::create(path, scenario, run.states.front(), value);
        ASSERT_TRUE(first) << first.error().message();
        for (std::size_t i = 0; i < run.traces.size(); ++i) {
            if (i == 60) {
                const auto second = RecordingWriter::create(path, scenario, run.states.front(), {}, "", {true});
                ASSERT_FALSE(second);
                EXPECT_EQ(second.error().message(),
                          path.string() + ": is being written by a running program; " + "expected another name");
                EXPECT_FALSE(writeFileAtomically(path, "other"));
            }
            first->add(run.states[i + 1], run.traces[i]);
        }
        const auto closed = first->close();
        ASSERT_TRUE(closed) << closed.error().message();
    }
    const auto recording = openRecording(path);
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_TRUE(recording->damage.empty());
    expectStates(recording->branches[0].timeline, run);
    EXPECT_TRUE(RecordingWriter::create(path, scenario, run.states.front(), {}, "", {true})) << "once it is closed";
}

TEST_F(RecordingFile, RecordingDoesNotChangeTheRun) {
    auto writer = RecordingWriter::create(folder.path() / "a.mcap", scenario, run.states.front());
    ASSERT_TRUE(writer);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    for (std::int64_t i = 0; i < ticks; ++i) {
        step(scenario, state, buffers, {}, &trace);
        writer->add(state, trace);
    }
    WorldState without = scenario.initialState();
    for (std::int64_t i = 0; i < ticks; ++i) step(scenario, without, buffers);
    EXPECT_FALSE(firstDifference(state, without));
    EXPECT_FALSE(firstDifference(state, run.states.back()));
    // The same run gives the same file.
    ASSERT_TRUE(writer->close());
    auto again = RecordingWriter::create(folder.path() / "b.mcap", scenario, run.states.front());
    for (std::size_t i = 0; i < run.traces.size(); ++i) again->add(run.states[i + 1], run.traces[i]);
    ASSERT_TRUE(again->close());
    EXPECT_EQ(*readFile(folder.path() / "a.mcap"), *readFile(folder.path() / "b.mcap"));
}

}  // namespace
}  // namespace mrose
