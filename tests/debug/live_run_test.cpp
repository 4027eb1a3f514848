// A run that plays in turns and is written to a file, against stepping the world.
#include "debug/live_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/step.h"
#include "support/full_disk.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "workflow/open_run.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

using testing::HasSubstr;

class LiveRunTest : public testing::Test {
protected:
    LiveRunTest() {
        live.setSpeed(0);
        live.open(*openRun({"soccer.toml"}));
    }
    /// Plays up to a tick, in turns that begin anew whenever one has shown something.
    void playTo(std::int64_t tick) {
        live.debugger().stopAt(tick);
        live.debugger().play();
        while (live.debugger().playing()) turns += live.turn(false, goesOn) ? 1 : 0;
    }
    /// All that is due without anybody asking.
    void rest() {
        live.debugger().stop();
        while (live.goesOn()) live.turn(false, goesOn);
    }
    const std::string file() const { return (folder.path() / "kept.mcap").string(); }

    const TemporaryFolder folder;
    const Progress goesOn = [](double) { return true; };
    std::vector<Expected<void>> ended;
    LiveRun live{[this](const Expected<void>& written) { ended.push_back(written); }};
    int turns = 0;
};

TEST_F(LiveRunTest, PlaysAsSteppingDoes) {
    const auto scenario = live.debugger().run().setup().scenario;
    WorldState stepped = live.debugger().run().state();
    playTo(300);
    StepBuffers buffers;
    while (stepped.tick < 300) step(*scenario, stepped, buffers);
    EXPECT_EQ(hashOf(live.debugger().run().state()), hashOf(stepped));
    EXPECT_GT(turns, 0);
    rest();
    EXPECT_FALSE(live.turn(false, goesOn)) << "something new where nothing is due";
    EXPECT_TRUE(live.turn(true, goesOn));
}

TEST_F(LiveRunTest, FileHoldsAllWhenItsRecordingEnds) {
    playTo(50);
    ASSERT_TRUE(live.record(file(), "", false));
    playTo(120);
    const StateHash last = hashOf(live.debugger().run().state());
    live.stopRecording();
    ASSERT_EQ(ended.size(), 1u);
    EXPECT_TRUE(ended[0]);
    live.stopRecording();
    EXPECT_EQ(ended.size(), 1u) << "what is not recorded does not end";
    const auto again = openRun({file()});
    ASSERT_TRUE(again) << again.error().message();
    LiveRun other([](const Expected<void>&) {});
    other.open(*again);
    EXPECT_EQ(other.debugger().run().last(), 120);
    other.debugger().goTo(120, false);
    EXPECT_EQ(hashOf(other.debugger().run().state()), last);
}

TEST_F(LiveRunTest, AnotherRunEndsTheFileOfTheOneBefore) {
    ASSERT_TRUE(live.record(file(), "", false));
    playTo(30);
    live.open(*openRun({"soccer.toml"}));
    ASSERT_EQ(ended.size(), 1u);
    EXPECT_TRUE(ended[0]);
    EXPECT_EQ(openRun({file()})->setup->scenario->scene().robots.size(),
              live.debugger().run().setup().scene().robots.size());
}

TEST_F(LiveRunTest, FullDiskEndsTheFileAndNotTheRun) {
    ASSERT_TRUE(live.record(file(), "", false));
    {
        const FullDisk full(std::filesystem::file_size(file()));
        playTo(40);
        rest();
        live.stopRecording();
    }
    ASSERT_EQ(ended.size(), 1u);
    ASSERT_FALSE(ended[0]);
    EXPECT_THAT(ended[0].error().message(), HasSubstr("kept.mcap"));
    playTo(80);
    EXPECT_EQ(live.debugger().run().tick(), 80);
}

}  // namespace
}  // namespace mrose
