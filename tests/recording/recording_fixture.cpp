#include "recording/recording_fixture.h"

#include "recording/playback.h"
#include "world/state_difference.h"

namespace mrose {

std::filesystem::path RecordingFile::record(const RecordingWriter::Options& options) {
    const std::filesystem::path path = folder.path() / "run.mcap";
    auto writer = RecordingWriter::create(path, scenario, run.states.front(), value, "mrose run x", options);
    EXPECT_TRUE(writer) << writer.error().message();
    for (std::size_t i = 0; i < run.traces.size(); ++i) {
        writer->add(run.states[i + 1], run.traces[i]);
        if (i == 17 || i == 18 || i == 100) writer->flush();
        if (i != 120) continue;
        EXPECT_EQ(writer->beginBranch(0, branchRun.states.front(), "pushed"), 1u);
        for (std::size_t k = 0; k < branchRun.traces.size(); ++k)
            writer->add(branchRun.states[k + 1], branchRun.traces[k], 1);
    }
    writer->keep(run.states.back());
    const auto closed = writer->close();
    EXPECT_TRUE(closed) << closed.error().message();
    return path;
}

WorldState RecordingFile::pushed(WorldState state) {
    state.objects[0].velocity_W.y -= 1.5;
    return state;
}

void RecordingFile::expectStates(const Timeline& timeline, const StraightRun& straight) const {
    Playback playback(scenario);
    const std::int64_t start = straight.states.front().tick;
    EXPECT_EQ(timeline.first(), start);
    for (std::int64_t tick = timeline.first(); tick <= timeline.last(); ++tick) {
        const auto reached = playback.reach(timeline, tick);
        ASSERT_TRUE(reached) << reached.error().message();
        EXPECT_TRUE(reached->worldSame && reached->memoriesSame);
        const auto difference =
            firstDifference(straight.states[static_cast<std::size_t>(tick - start)], reached->state);
        ASSERT_FALSE(difference) << tick << ": " << difference->message();
    }
}

}  // namespace mrose
