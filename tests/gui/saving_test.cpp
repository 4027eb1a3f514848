// What a saved recording or scenario holds, as whoever opens it finds it.
#include <QApplication>
#include <QFileDialog>
#include <QFileInfo>
#include <QInputDialog>
#include <QLineEdit>
#include <QTimer>
#include <functional>

#include <gmock/gmock.h>

#include "debug/shown.h"
#include "files/window_files.h"
#include "gui/file_fixture.h"
#include "io/file.h"
#include "widgets/field_view.h"

namespace mrose::gui {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Edits that were taken together are one branch in the file, and what no controller decided is there, too.
TEST_F(FileTest, RecordedEditsAreOneBranch) {
    open(writeGame());
    seek(100);
    window.files().saver().record(qPath("live.mcap"), false);
    throwBall();
    throwBall();
    settle();
    const StateHash thrown = window.shown()->hash;
    seek(120);
    throwBall();
    const int listed = listedBranches(window.shown()->branches);
    EXPECT_EQ(listed, 3);
    window.files().saver().record({}, false);
    settle();
    ASSERT_TRUE(window.actions().perform("save_recording", qPath("saved.mcap")));
    for (const char* name : {"live.mcap", "saved.mcap"}) {
        open(path(name));
        EXPECT_EQ(window.shown()->branches.size(), 3u) << name;
        EXPECT_EQ(window.shown()->branch, 2u) << name;
        EXPECT_EQ(window.shown()->branches[2].parent, 1u) << name;
        EXPECT_EQ(state().tick, 120) << name;
        window.session().show(1, 100);
        settle();
        EXPECT_EQ(window.shown()->hash, thrown) << name;
    }
}

TEST_F(FileTest, StartLinesOfASavedStateSayWhereItIs) {
    open(writeGame());
    seek(30);
    const Pose there = state().robots[0].pose;
    ASSERT_TRUE(window.actions().perform("save_scenario", qPath("later.toml")));
    ASSERT_TRUE(waitFor([&] { return !notes().empty(); }));
    open(path("later.toml"));
    EXPECT_THAT(notes(), IsEmpty());
    // Without the state the robots stand where they stood.
    std::string text = readFile(path("later.toml")).value_or("");
    const std::size_t key = text.find("initial_state = ");
    ASSERT_NE(key, text.npos);
    write("starts.toml", std::string(text).erase(key, text.find('\n', key) - key));
    open(path("starts.toml"));
    EXPECT_EQ(state().tick, 0);
    EXPECT_NEAR(state().robots[0].pose.x, there.x, 1e-9);
    EXPECT_NEAR(state().robots[0].pose.y, there.y, 1e-9);
    // Who changes a start line is told what holds.
    const std::size_t start = text.find("x_m = ", text.find("start", text.find("[[robot]]")));
    ASSERT_NE(start, text.npos);
    text.insert(start + 6, text[start + 6] == '-' ? "" : "1");
    if (text[start + 6] == '-') text.insert(start + 7, "1");
    write("later.toml", text);
    open(path("later.toml"));
    EXPECT_THAT(notes(), ElementsAre(AllOf(HasSubstr("start lines of one"), HasSubstr("initial_state"))));
    EXPECT_EQ(state().robots[0].pose, there);
}

/// What the next file dialogue begins with; it is left.
struct Asked {
    QString title, folder;
    QStringList files;
};
void leaveFileDialogue(Asked& asked) {
    QTimer::singleShot(0, [&asked] {
        auto* dialogue = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
        if (dialogue == nullptr) return leaveFileDialogue(asked);
        asked = {dialogue->windowTitle(), dialogue->directory().path(), {}};
        auto* name = dialogue->findChild<QLineEdit*>("fileNameEdit");
        if (name != nullptr) asked.files << name->text();
        dialogue->reject();
    });
}

TEST_F(FileTest, DialoguesSuggestANameOfTheRunInTheFolderUsedLast) {
    open(writeGame());
    const auto suggested = [&](const char* name) {
        Asked asked;
        leaveFileDialogue(asked);
        action(name).trigger();
        EXPECT_EQ(asked.folder.toStdString(), folder.path().string()) << name;
        return asked.files.join(' ').toStdString();
    };
    EXPECT_EQ(suggested("save_recording"), "game.mcap");
    EXPECT_EQ(suggested("record_to"), "game.mcap");
    EXPECT_EQ(suggested("save_scenario"), "game_state.toml");
    EXPECT_EQ(suggested("save_image"), "game.png");
    // Nothing that is there is written over unasked.
    write("game.mcap", "");
    EXPECT_EQ(suggested("save_recording"), "game_2.mcap");
}

TEST_F(FileTest, RenamingABranchBeginsWithItsName) {
    open(writeGame());
    seek(10);
    throwBall();
    QString suggested;
    std::function<void()> answer = [&] {
        auto* dialogue = qobject_cast<QInputDialog*>(QApplication::activeModalWidget());
        if (dialogue == nullptr) return QTimer::singleShot(0, answer);
        suggested = dialogue->textValue();
        dialogue->setTextValue(suggested + " far");
        dialogue->accept();
    };
    QTimer::singleShot(0, answer);
    action("rename_branch").trigger();
    settle();
    EXPECT_EQ(suggested, "thrown");
    EXPECT_EQ(window.shown()->branches[1].name, "thrown far");
}

TEST_F(FileTest, NetworkIsLookedForWhereNetworksAreAndForARobot) {
    open(writeGame());
    window.field().setSelected(1);
    Asked asked;
    leaveFileDialogue(asked);
    action("swap_model").trigger();
    EXPECT_EQ(asked.title.toStdString(), "Motion network for " + window.shown()->frame->nameOf(1));
    EXPECT_TRUE(QFileInfo::exists(asked.folder + "/pioneer.net")) << asked.folder.toStdString();
}

}  // namespace
}  // namespace mrose::gui
