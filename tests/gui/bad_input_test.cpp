// What is wrong with a file, a disk or a plug-in is said in the window, and it goes on.
#include <algorithm>
#include <filesystem>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "files/window_files.h"
#include "gui/file_fixture.h"
#include "io/file.h"
#include "recording/recording.h"
#include "recording/recording_writer.h"
#include "support/full_disk.h"
#include "support/places.h"
#include "support/recording_metadata.h"
#include "support/run_program.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"
#include "world/state_hash.h"

namespace mrose::gui {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class BadInput : public FileTest {
protected:
    void SetUp() override {
        open(writeGame());
        seek(50);
        before_ = window.shown()->hash;
    }
    /// One line is said, and what was open is still open.
    std::string refusal(const std::string& file) {
        window.messages().clear();
        dropFile(file);
        settle();
        EXPECT_EQ(window.shown()->hash, before_);
        EXPECT_EQ(errors().size(), 1u) << file;
        EXPECT_EQ(window.files().opened()->file, path("game.toml"));
        const std::string said = errors().empty() ? "" : errors().front();
        EXPECT_EQ(said.find('\n'), said.npos);
        EXPECT_THAT(said, HasSubstr(file));
        return said;
    }
    StateHash before_;
};

TEST_F(BadInput, ForeignFilesAreNamedAndRefused) {
    std::string random;
    for (unsigned i = 0, x = 1; i < 5000; ++i) random += static_cast<char>((x = x * 1664525 + 1013904223) >> 24);
    EXPECT_THAT(refusal(write("random", random)), HasSubstr("expected a scenario"));
    EXPECT_THAT(refusal(write("random.toml", random)), HasSubstr("expected a scenario"));
    EXPECT_THAT(refusal(write("picture.png", "\x89PNG\r\n\x1a\n" + random)), HasSubstr("expected a scenario"));
    EXPECT_THAT(refusal(write("empty.toml", "")), HasSubstr("is empty"));
    EXPECT_THAT(refusal(write("letter.txt", "Dear reader\n")), HasSubstr("is none of the files"));
    EXPECT_THAT(refusal(write("robot.toml", robot())), HasSubstr("describes a robot"));
    EXPECT_THAT(refusal(write("wrong.toml", "format = \"mrose scenario\"\nversion = 1\nname = 3\n")),
                HasSubstr("wrong.toml:3"));
    EXPECT_THAT(refusal(write("open.toml", "[=")), HasSubstr("open.toml:1"));
    EXPECT_THAT(refusal(write("foreign.mcap", "\x89MCAP0\r\n" + random)), HasSubstr("is no recording of mrose"));
    EXPECT_THAT(refusal(write("cut.mcap", "\x89MCAP0\r")), HasSubstr("is no MCAP file"));
}

TEST_F(BadInput, WhatIsNoFileIsNeverWaitedFor) {
    std::filesystem::create_directory(path("folder.toml"));
    EXPECT_THAT(refusal(path("folder.toml")), HasSubstr("is a folder"));
    ASSERT_EQ(::mkfifo(path("pipe.toml").c_str(), 0600), 0);
    EXPECT_THAT(refusal(path("pipe.toml")), HasSubstr("is no regular file"));
    EXPECT_THAT(refusal("/dev/zero"), HasSubstr("is no regular file"));
    EXPECT_THAT(refusal(path("missing.toml")), HasSubstr("does not exist"));
    // Nor one that a scenario names.
    ASSERT_EQ(::mkfifo(path("mine2.toml").c_str(), 0600), 0);
    std::string text = game();
    text.replace(text.find("\"mine.toml\""), 11, "\"mine2.toml\"");
    write("piped.toml", text);
    window.messages().clear();
    dropFile(path("piped.toml"));
    settle();
    EXPECT_THAT(errors(), ElementsAre(HasSubstr("mine2.toml: is no regular file")));
}

TEST_F(BadInput, WhatMayNotBeReadIsSaid) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
    const std::string file = write("secret.toml", game());
    ::chmod(file.c_str(), 0);
    EXPECT_THAT(refusal(file), HasSubstr("Permission denied"));
}

/// Holes take no room on the disk.
TEST_F(BadInput, HugeFilesAreRefusedWithoutReadingThem) {
    const std::string zeros = write("zeros.toml", ""), recording = write("huge.mcap", "\x89MCAP0\r\n");
    std::filesystem::resize_file(zeros, std::uintmax_t{3} << 30);
    std::filesystem::resize_file(recording, std::uintmax_t{1} << 42);
    EXPECT_THAT(refusal(zeros), HasSubstr("expected a scenario"));
    EXPECT_THAT(refusal(recording), HasSubstr("more than half of this computer's memory"));
    const std::string scenario = write("long.toml", "format = \"mrose scenario\"\n");
    std::filesystem::resize_file(scenario, std::uintmax_t{3} << 30);
    EXPECT_THAT(refusal(scenario), HasSubstr("long.toml"));
}

TEST_F(BadInput, WhatComesFromElsewhereIsSaid) {
    drop({QUrl("https://example.org/soccer.toml")});
    settle();
    EXPECT_THAT(notes(), ElementsAre(HasSubstr("Only files of this computer")));
    EXPECT_EQ(window.shown()->hash, before_);
}

TEST_F(BadInput, HalfWrittenRecordingIsShownUpToItsDamage) {
    const std::string recording = path("game.mcap");
    ASSERT_EQ(runMrose({"run", path("game.toml"), "--record", recording, "--quiet"}).status, 0);
    const std::uintmax_t size = std::filesystem::file_size(recording);
    std::filesystem::resize_file(recording, size * 6 / 10);
    const auto kept = openRecording(recording);
    ASSERT_TRUE(kept);
    const std::int64_t last = kept->branches[0].timeline.last();
    dropFile(recording);
    settle();
    EXPECT_THAT(notes(), ElementsAre(AllOf(HasSubstr("cut off at byte"), HasSubstr("shown up to there"))));
    EXPECT_EQ(window.shown()->last, last);
    seek(last);
    EXPECT_EQ(window.shown()->hash, hashAt(*scenarioOf(path("game.toml")), last));
}

/// Sizes that a file says are not believed.
TEST_F(BadInput, RecordingOfImpossibleControllersIsRefused) {
    const std::string recording = path("game.mcap");
    ASSERT_EQ(runMrose({"run", path("game.toml"), "--record", recording, "--quiet", "--duration", "1"}).status, 0);
    const std::string whole = readFile(recording).value_or("");
    mcap::Strings needs = metadataOf(whole, "mrose.controllers");
    const std::string memory = needs["0"].substr(0, needs["0"].find(' '));
    for (const char* huge : {"9000000000000000000 1", "18446744073709551615 1", "4294967296 18446744073709551615"}) {
        needs["0"] = huge;
        EXPECT_THAT(refusal(write("huge.mcap", withMetadata(whole, "mrose.controllers", needs))),
                    HasSubstr("bytes of memory for robot 1; its first state holds"));
    }
    needs["0"] = memory + " 18446744073709551615";
    EXPECT_THAT(refusal(write("huge.mcap", withMetadata(whole, "mrose.controllers", needs))),
                HasSubstr("places for commands; the scenario has"));
}

TEST_F(BadInput, NetworkNeedsARobot) {
    const std::string network = (std::filesystem::path(path("a.net"))).string();
    for (const char* format : {"mrose motion network", "mrose network"}) {
        write("a.net", std::string("format = \"") + format + "\"\n");
        dropFile(network);
        settle();
        EXPECT_THAT(notes(), ElementsAre(HasSubstr("select a robot first"))) << format;
    }
    window.field().setSelected(2);  // the ball
    dropFile(network);
    settle();
    EXPECT_THAT(notes(), ElementsAre(HasSubstr("select a robot first")));
    EXPECT_EQ(window.shown()->hash, before_);
}

/// Room does not help where writing is not allowed.
TEST_F(BadInput, AdviceIsOfWhatWentWrong) {
    std::filesystem::create_directory(path("shut"));
    std::filesystem::permissions(path("shut"), std::filesystem::perms::owner_read);
    const std::string file = ::access(path("shut").c_str(), W_OK) == 0 ? "/sys/kernel/saved.mcap" : path("shut/a.mcap");
    (void)window.actions().perform("save_recording", qtText(file));
    ASSERT_TRUE(waitFor([&] { return !errors().empty(); }));
    EXPECT_THAT(errors(), ElementsAre(AllOf(HasSubstr("Nothing may be written there"), Not(HasSubstr("room")))));
}

TEST_F(BadInput, FullDiskWhileSavingLeavesWhatWasThereAndTheRun) {
    write("old.mcap", "old");
    throwBall();
    {
        const FullDisk full(4000);
        ASSERT_TRUE(window.actions().perform("save_recording", qPath("old.mcap")));
        ASSERT_TRUE(waitFor([&] { return !errors().empty(); }));
    }
    EXPECT_THAT(errors(), ElementsAre(AllOf(HasSubstr("old.mcap"), HasSubstr("Make room, or save it elsewhere"))));
    EXPECT_EQ(readFile(path("old.mcap")).value_or(""), "old");
    EXPECT_TRUE(window.files().saver().hasUnsaved());
    seek(60);
    EXPECT_EQ(state().tick, 60);
}

TEST_F(BadInput, FullDiskWhileRecordingEndsTheFileAndNotTheRun) {
    window.files().saver().record(qPath("kept.mcap"));
    settle();
    ASSERT_TRUE(waitFor([&] { return openRecording(path("kept.mcap")).has_value(); }));
    {
        const FullDisk full(std::filesystem::file_size(path("kept.mcap")) + 20'000);
        seek(2000);
        ASSERT_TRUE(waitFor([&] { return !errors().empty(); }));
    }
    EXPECT_THAT(errors(), ElementsAre(AllOf(HasSubstr("the run goes on"), HasSubstr("make room, then save"))));
    EXPECT_FALSE(action("stop_recording").isEnabled());
    EXPECT_EQ(state().tick, 2000);
    const auto kept = openRecording(path("kept.mcap"));
    ASSERT_TRUE(kept) << kept.error().message();
    EXPECT_GT(kept->branches[0].timeline.last(), 50);
    // And all of it can be saved once there is room.
    window.messages().clear();
    ASSERT_TRUE(window.actions().perform("save_recording", qPath("all.mcap")));
    ASSERT_TRUE(waitFor([&] { return !notes().empty(); }));
    const auto all = openRecording(path("all.mcap"));
    ASSERT_TRUE(all);
    EXPECT_EQ(all->branches[0].timeline.last(), 2000);
}

/// Ends as on a full disk, whoever finds it: who stops it, or the run that goes on.
TEST_F(BadInput, RecordingWhoseFileIsGoneIsNoSuccess) {
    window.files().saver().record(qPath("gone.mcap"));
    seek(40);
    std::filesystem::remove(path("gone.mcap"));
    action("stop_recording").trigger();
    settle();
    EXPECT_THAT(errors(), ElementsAre(AllOf(HasSubstr("gone.mcap: is no longer there: it was removed"),
                                            HasSubstr("the run goes on"), HasSubstr("save all of it"))));
    EXPECT_THAT(notes(), testing::IsEmpty());
    window.messages().clear();

    window.files().saver().record(qPath("left.mcap"));
    settle();
    std::filesystem::rename(path("left.mcap"), path("moved.mcap"));
    window.session().play();
    ASSERT_TRUE(waitFor([&] { return !errors().empty(); }));
    EXPECT_THAT(errors(), ElementsAre(HasSubstr("left.mcap: is no longer there: it was moved")));
    EXPECT_FALSE(action("stop_recording").isEnabled());
    window.session().pause();
    settle();
    const std::int64_t stood = state().tick;
    ASSERT_TRUE(window.actions().perform("save_recording", qPath("left.mcap")));
    ASSERT_TRUE(waitFor([&] { return !notes().empty(); }));
    EXPECT_EQ(openRecording(path("left.mcap"))->branches[0].timeline.last(), stood);
}

/// Of another program or of this one; neither loses anything.
TEST_F(BadInput, WhatIsBeingWrittenIsNotWrittenOver) {
    window.files().saver().record(qPath("mine.mcap"));
    settle();
    (void)window.actions().perform("save_recording", qPath("mine.mcap"));
    ASSERT_TRUE(waitFor([&] { return !errors().empty(); }));
    EXPECT_THAT(errors(), ElementsAre(AllOf(HasSubstr("mine.mcap: is being written by a running program"),
                                            HasSubstr("Nothing is lost"))));
    window.messages().clear();
    {
        const auto scenario = scenarioOf(path("game.toml"));
        const auto other = RecordingWriter::create(path("theirs.mcap"), *scenario, scenario->initialState());
        ASSERT_TRUE(other);
        const std::string before = readFile(path("theirs.mcap")).value_or("");
        window.files().saver().record(qPath("theirs.mcap"));
        ASSERT_TRUE(waitFor([&] { return !errors().empty(); }));
        EXPECT_THAT(errors(), ElementsAre(AllOf(HasSubstr("theirs.mcap: is being written by a running program"),
                                                HasSubstr("Nothing is recorded"))));
        EXPECT_EQ(readFile(path("theirs.mcap")).value_or(""), before);
    }
    const auto mine = openRecording(path("mine.mcap"));
    ASSERT_TRUE(mine);
    EXPECT_THAT(mine->damage, testing::IsEmpty());
}

TEST_F(BadInput, RecordingToADeviceIsRefused) {
    window.files().saver().record("/dev/full");
    ASSERT_TRUE(waitFor([&] { return !errors().empty(); }));
    EXPECT_THAT(errors(), ElementsAre(AllOf(HasSubstr("/dev/full"), HasSubstr("Nothing is recorded"))));
    EXPECT_EQ(window.shown()->hash, before_);
}

TEST_F(BadInput, WhatTheRunIsMadeFromIsNotWrittenOver) {
    EXPECT_FALSE(window.actions().perform("save_recording", qPath("./mine.toml")));
    window.files().saver().record(qPath("game.toml"));
    EXPECT_THAT(errors(), ElementsAre(HasSubstr("is a file that the run is made from")));
    settle();
    EXPECT_EQ(readFile(path("mine.toml")).value_or(""), robot());
    EXPECT_EQ(readFile(path("game.toml")).value_or(""), game());
}

class BadPlugin : public FileTest {
protected:
    /// A game in which "one" is driven by the plug-in that misbehaves so from 0.5 s on.
    OpenRequest misbehaving(const std::string& how) {
        writeGame();
        std::string text = game();
        const std::string built = "controller = { kind = \"chase_ball\", target_m = [4.8, 0.0] }";
        text.replace(text.find(built), built.size(),
                     "controller = { kind = \"plugin\", library = \"" MROSE_TEST_PLUGINS
                     "/misbehaving.so\", options = { how = \"" +
                         how + "\", after_s = 0.5 } }");
        OpenRequest request{write("plugin.toml", text)};
        request.pluginLimit = 0.2;
        return request;
    }
    void expectNamed(const std::string& how, const std::string& what, const std::string& advice = "press F5") {
        ASSERT_TRUE(window.files().openNow(misbehaving(how)));
        settle();
        seek(20);
        EXPECT_THAT(errors(), IsEmpty());
        seek(100);
        EXPECT_EQ(state().tick, 100);
        EXPECT_THAT(errors(), ElementsAre(AllOf(HasSubstr("one at 0.5"), HasSubstr(what), HasSubstr(advice))));
        ASSERT_EQ(window.shown()->frame->failed.size(), 1u) << "its name says so";
        EXPECT_EQ(window.shown()->frame->nameOf(window.shown()->frame->failed[0]), "one");
        // The others go on.
        EXPECT_NE(state().robots[1].pose.x, 1.0);
        // Before it happened there is nothing to say.
        seek(10);
        EXPECT_THAT(errors(), IsEmpty());
        EXPECT_THAT(window.shown()->frame->failed, IsEmpty());
    }
};

TEST_F(BadPlugin, MakesARunWithoutADisplayFail) {
    for (const auto& [how, status] : {std::pair{"crash", 1}, std::pair{"", 0}}) {
        const std::string gui = (std::filesystem::path(mroseProgram()).parent_path() / "mrose-gui").string();
        const ProgramResult result =
            RunningProgram({gui, "--offscreen", "--run", misbehaving(how).file, "--ticks", "50"}).finish();
        EXPECT_EQ(result.status, status) << result.err;
        EXPECT_EQ(result.err.find("misbehaving.so") != result.err.npos, status != 0) << result.err;
    }
}

TEST_F(BadPlugin, ThatCrashesStopsItsRobotAndIsNamed) { expectNamed("crash", "misbehaving.so"); }
TEST_F(BadPlugin, ThatHangsStopsItsRobotAndIsNamed) { expectNamed("loop", "misbehaving.so", "--plugin-limit"); }
/// While it hangs the window is alive and says for whom it waits.
TEST_F(BadPlugin, ThatHangsIsWaitedForInTheBackground) {
    OpenRequest request = misbehaving("loop");
    request.pluginLimit = 2.5;
    ASSERT_TRUE(window.files().openNow(request));
    settle();
    window.session().seek(100);
    const auto waits = [&] {
        const std::vector<std::string> lines = said(MessageBar::Kind::progress);
        return std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
            return line.find("Waiting for a decision of misbehaving.so") != line.npos;
        });
    };
    ASSERT_TRUE(waitFor(waits));
    ASSERT_TRUE(waitFor([&] { return !errors().empty(); }));
    EXPECT_THAT(errors(), ElementsAre(HasSubstr("misbehaving.so took longer than 2.5 s")));
    EXPECT_FALSE(waits());
}

TEST_F(BadPlugin, ThatThrowsIsNamed) { expectNamed("throw", "index 7"); }

TEST_F(BadPlugin, ThatCrashesWhileLoadingIsNamed) {
    open(writeGame());
    EXPECT_FALSE(window.files().openNow(misbehaving("crash while loading")));
    EXPECT_THAT(errors(), ElementsAre(HasSubstr("misbehaving.so")));
    EXPECT_EQ(window.files().opened()->file, path("game.toml"));
}

/// A recording is looked at without its plug-in.
TEST_F(BadPlugin, ThatIsGoneLeavesItsRecording) {
    std::filesystem::copy_file(MROSE_TEST_PLUGINS "/misbehaving.so", path("own.so"));
    misbehaving("none");
    std::string text = readFile(path("plugin.toml")).value_or("");
    const std::string library = MROSE_TEST_PLUGINS "/misbehaving.so";
    text.replace(text.find(library), library.size(), "own.so");
    write("plugin.toml", text);
    ASSERT_EQ(runMrose({"run", path("plugin.toml"), "--isolate", "--record", path("game.mcap"), "--quiet"}).status, 0);
    open(path("game.mcap"), 2.0);
    EXPECT_THAT(notes(), IsEmpty());
    const StateHash with = window.shown()->hash;
    std::filesystem::remove(path("own.so"));
    open(path("game.mcap"), 2.0);
    EXPECT_THAT(notes(), ElementsAre(AllOf(HasSubstr("own.so"), HasSubstr("do as recorded"))));
    EXPECT_EQ(window.shown()->hash.world, with.world);
}

}  // namespace
}  // namespace mrose::gui
