// What the window does with files beside what is asked at the same time: saves that are refused, kept breakpoints,
// descriptions that are written while they are read.
#include "files/window_files.h"

#include <QFileDialog>
#include <QSettings>
#include <QTimer>

#include <gmock/gmock.h>

#include "frame/window_memory.h"
#include "gui/file_fixture.h"
#include "io/file.h"
#include "reality/overlay.h"
#include "support/places.h"
#include "workflow/open_run.h"

namespace mrose::gui {
namespace {

using testing::ElementsAre;

class WindowFilesTest : public FileTest {};

void leaveFileDialogue() {
    QTimer::singleShot(0, [] {
        auto* dialogue = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
        if (dialogue == nullptr) return leaveFileDialogue();
        dialogue->reject();
    });
}

TEST_F(WindowFilesTest, SaveThatWasLeftIsForgotten) {
    open(writeGame());
    throwBall();
    window.files().saver().setQuestion([](const QString&) { return RunSaver::Answer::save; });
    leaveFileDialogue();
    window.close();
    ASSERT_TRUE(window.isVisible());
    ASSERT_TRUE(window.files().saver().saveRecording(qPath("later.mcap")));
    ASSERT_TRUE(waitFor([&] { return !window.files().saver().hasUnsaved(); }));
    settle();
    EXPECT_TRUE(window.isVisible());
}

TEST_F(WindowFilesTest, LogsBreakpointsAreKeptByTheLog) {
    const auto settings = [&] { return std::make_unique<QSettings>(qPath("kept.ini"), QSettings::IniFormat); };
    const auto texts = [](const MainWindow& of) {
        std::vector<std::string> all;
        for (const BreakpointState& state : of.shown()->breakpoints) all.push_back(state.breakpoint.text);
        return all;
    };
    const auto only = [this](const char* text) {
        Breakpoint breakpoint;
        breakpoint.text = text;
        window.session().setBreakpoints({breakpoint});
        settle();
    };
    const auto openLog = [](MainWindow& in) {
        const auto log = sourceFolder() / "resources" / "logs" / "pioneer" / "random.csv";
        ASSERT_TRUE(in.overlay().openNow({log.string(), ""}));
        in.session().settle();
        QApplication::processEvents();
    };
    window.frame().memory.restore(settings());
    const std::string file = writeGame();
    open(file);
    only("time > 7");
    openLog(window);
    only("time > 3");
    window.frame().memory.save();
    MainWindow other;
    other.frame().memory.restore(settings());
    ASSERT_TRUE(other.files().openNow({file}));
    other.session().settle();
    EXPECT_THAT(texts(other), ElementsAre("time > 7"));
    openLog(other);
    EXPECT_THAT(texts(other), ElementsAre("time > 3"));
}

TEST_F(WindowFilesTest, WhatWasWrittenAfterItWasReadIsTold) {
    const std::string file = write("a.toml", "one");
    const std::string read = contentHash("one");
    write("a.toml", "two");
    DescriptionWatch watch;
    std::vector<std::string> told;
    QObject::connect(&watch, &DescriptionWatch::changed, [&](const std::vector<std::string>& files) {
        told.insert(told.end(), files.begin(), files.end());
    });
    watch.watch({{file, read}});
    EXPECT_TRUE(waitFor([&] { return !told.empty(); }));
    watch.check();
    watch.settle();
    EXPECT_THAT(told, ElementsAre(file));
}

TEST_F(WindowFilesTest, ReloadThatComesToNothingLeavesTheUsersBranchUnsaved) {
    const std::string file = writeGame();
    open(file);
    throwBall();
    ASSERT_TRUE(window.files().saver().hasUnsaved());
    for (const bool fits : {false, true}) {
        auto run = openRun({file});
        ASSERT_TRUE(run);
        if (!fits) run->start.robots.pop_back();
        window.files().takeReloaded(std::move(run), "mended");
        settle();
        EXPECT_EQ(window.shown()->branches.size(), fits ? 3u : 2u);
        EXPECT_TRUE(window.files().saver().hasUnsaved());
    }
    ASSERT_TRUE(window.files().saver().saveRecording(qPath("all.mcap")));
    EXPECT_TRUE(waitFor([&] { return !window.files().saver().hasUnsaved(); }));
}

/// Its duration counts from where it branched.
TEST_F(WindowFilesTest, TimelineOfATrialThatBranchedEndsWhereItsRunDoes) {
    OpenRequest request{
        write("x.toml",
              "format = \"mrose experiment\"\nversion = 1\nname = \"x\"\nscenario = \"soccer.toml\"\ntrials = 1\n"
              "branch = 'time > 1.5'\nbranch_within_s = 3.0\nduration_s = 1.0\n[[variant]]\nname = \"on\"\n")};
    request.trial = 1;
    ASSERT_TRUE(window.files().openNow(request, {}));
    settle();
    EXPECT_EQ(window.timeline().content().first, 76);
    EXPECT_EQ(window.timeline().content().end, 76 + 50);
}

}  // namespace
}  // namespace mrose::gui
