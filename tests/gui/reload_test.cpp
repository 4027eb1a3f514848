// What is open is read again when its files change, and said what has become of them.
#include <QTest>
#include <filesystem>

#include <gmock/gmock.h>

#include "debug/shown.h"
#include "files/window_files.h"
#include "gui/file_fixture.h"
#include "recording/recording.h"
#include "widgets/field_view.h"
#include "widgets/timeline_bar.h"
#include "world/state_hash.h"

namespace mrose::gui {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class ReloadTest : public FileTest {
protected:
    void SetUp() override {
        open(writeGame());
        seek(100);
        before_ = window.shown()->hash;
    }
    bool reloaded(std::size_t branches = 2) {
        return waitFor([&] { return window.shown()->branches.size() == branches && !window.session().busy(); });
    }
    void expectNewPhysics() {
        settle();
        EXPECT_EQ(state().tick, 100);
        EXPECT_NE(window.shown()->hash, before_);
        EXPECT_EQ(window.shown()->hash, hashAt(*scenarioOf(path("game.toml")), 100));
        EXPECT_THAT(errors(), IsEmpty());
        ASSERT_FALSE(window.shown()->frame->ghosts.empty());  // the run before
        action("undo").trigger();
        settle();
        EXPECT_EQ(window.shown()->branch, 0u);
    }

    StateHash before_;
};

TEST_F(ReloadTest, ChangedDescriptionIsReadAgainAndTheTickStays) {
    write("mine.toml", robot(30));
    ASSERT_TRUE(reloaded());
    EXPECT_EQ(window.shown()->branches[1].name, "mine.toml changed");
    expectNewPhysics();
}

TEST_F(ReloadTest, WhereOneLooksAndWhatIsSelectedStay) {
    window.QWidget::show();
    window.field().setSelected(1);
    window.timeline().zoom(3);
    settle();
    window.field().viewport().zoom(2.5);
    window.field().viewport().pan({30, 20});
    const ViewTransform view = window.field().transform();
    write("mine.toml", robot(30));
    ASSERT_TRUE(reloaded());
    settle();
    EXPECT_TRUE(window.field().transform() == view);
    EXPECT_EQ(window.field().selected(), 1u);
    EXPECT_EQ(window.timeline().zoomed(), 3);
    // Another file is another matter.
    write("other.toml", game(0.4));
    open(path("other.toml"));
    EXPECT_TRUE(window.field().viewport().showsAll());
    EXPECT_EQ(window.field().selected(), std::nullopt);
}

/// As editors save: another file takes the name.
TEST_F(ReloadTest, ReplacedFileIsReadAgainEachTime) {
    for (const double x : {0.2, 0.3}) {
        write("new", game(x));
        std::filesystem::rename(path("new"), path("game.toml"));
        ASSERT_TRUE(reloaded(x == 0.2 ? 2 : 3));
    }
    settle();
    EXPECT_EQ(window.shown()->hash, hashAt(*scenarioOf(path("game.toml")), 100));
}

TEST_F(ReloadTest, SavingTheSameTextChangesNothing) {
    write("mine.toml", robot());
    window.files().watch().check();
    window.files().watch().settle();
    settle();
    EXPECT_EQ(window.shown()->branches.size(), 1u);
    EXPECT_FALSE(window.files().opener().busy());
}

TEST_F(ReloadTest, MistakeIsShownWithItsLineAndTheRunGoesOn) {
    std::string text = robot();
    text.replace(text.find("mass_kg = 7.5"), 13, "mass_kg = -1 ");
    write("mine.toml", text);
    ASSERT_TRUE(waitFor([&] { return !errors().empty(); }));
    EXPECT_THAT(errors(), ElementsAre(HasSubstr(path("mine.toml") + ":8:")));
    EXPECT_THAT(errors().front(), HasSubstr("mass_kg"));
    settle();
    EXPECT_EQ(window.shown()->hash, before_);
    EXPECT_EQ(window.shown()->branches.size(), 1u);
    seek(110);
    EXPECT_EQ(state().tick, 110);
    seek(100);
    write("mine.toml", robot(30));
    ASSERT_TRUE(reloaded());
    expectNewPhysics();
}

TEST_F(ReloadTest, ReloadsByHand) {
    window.files().watch().watch({});
    write("mine.toml", robot(30));
    QTest::keyClick(&window, Qt::Key_F5);
    settle();
    ASSERT_EQ(window.shown()->branches.size(), 2u);
    expectNewPhysics();
}

TEST_F(ReloadTest, NothingChangedIsSaidAndNoBranchBegins) {
    const auto nothing = ElementsAre(HasSubstr("Nothing has changed in what game.toml is made from"));
    QTest::keyClick(&window, Qt::Key_F5);
    settle();
    EXPECT_EQ(window.shown()->branches.size(), 1u);
    EXPECT_THAT(notes(), nothing);
    // Touched, and written as it was; a script's reload, too.
    write("mine.toml", robot());
    window.messages().clear();
    ASSERT_TRUE(window.actions().perform("reload", {}));
    settle();
    EXPECT_EQ(window.shown()->branches.size(), 1u);
    EXPECT_THAT(notes(), nothing);
    // Once what has changed was taken back, it is other than what is read.
    window.files().watch().watch({});
    write("mine.toml", robot(30));
    QTest::keyClick(&window, Qt::Key_F5);
    settle();
    ASSERT_EQ(window.shown()->branches.size(), 2u);
    QTest::keyClick(&window, Qt::Key_F5);
    settle();
    EXPECT_EQ(window.shown()->branches.size(), 2u);
    EXPECT_THAT(notes(), nothing);
    action("undo").trigger();
    settle();
    QTest::keyClick(&window, Qt::Key_F5);
    settle();
    ASSERT_EQ(window.shown()->branches.size(), 3u);
    EXPECT_EQ(window.shown()->hash, hashAt(*scenarioOf(path("game.toml")), 100));
}

TEST_F(ReloadTest, BranchesOfReloadsHaveNamesOfTheirOwn) {
    for (const double mass : {20, 30, 40}) {
        write("mine.toml", robot(mass));
        ASSERT_TRUE(reloaded(window.shown()->branches.size() + 1));
    }
    std::vector<std::string> names;
    for (const BranchInfo& branch : window.shown()->branches) names.push_back(branch.name);
    EXPECT_THAT(names, ElementsAre("", "mine.toml changed", "mine.toml changed (2)", "mine.toml changed (3)"));
}

/// Nothing is lost, and what was said of the file is no more.
TEST_F(ReloadTest, FileThatIsGoneIsSaidOnceAndUntilItIsBack) {
    write("mine.toml", "mass_kg = ");
    ASSERT_TRUE(waitFor([&] { return !errors().empty(); }));
    std::filesystem::remove(path("mine.toml"));
    ASSERT_TRUE(waitFor([&] { return !notes().empty(); }));
    EXPECT_THAT(notes(), ElementsAre(AllOf(HasSubstr("mine.toml was removed"), HasSubstr("goes on"))));
    EXPECT_THAT(errors(), IsEmpty());
    EXPECT_EQ(window.shown()->hash, before_);
    seek(110);
    EXPECT_EQ(state().tick, 110);
    seek(100);
    write("mine.toml", robot(30));
    ASSERT_TRUE(reloaded());
    for (const std::string& note : notes()) EXPECT_THAT(note, testing::Not(HasSubstr("removed")));
    expectNewPhysics();
}

TEST_F(ReloadTest, EmptiedFileIsAnErrorOfIt) {
    write("game.toml", "");
    ASSERT_TRUE(waitFor([&] { return !errors().empty(); }));
    EXPECT_THAT(errors(), ElementsAre(AllOf(HasSubstr("game.toml: "), HasSubstr("goes on"))));
    EXPECT_EQ(window.shown()->hash, before_);
}

/// Another program writes it, as `mrose run --record` does.
class GrowingTest : public FileTest {
protected:
    void SetUp() override {
        other_.files().saver().setQuestion([](const QString&) { return RunSaver::Answer::discard; });
        ASSERT_TRUE(other_.files().openNow({writeGame()}));
        other_.files().saver().record(qPath("live.mcap"));
        growTo(90);
        open(path("live.mcap"));
    }
    void growTo(std::int64_t tick) {
        other_.session().seek(tick);
        other_.session().settle();
        ASSERT_TRUE(waitFor([&] {
            const auto recording = openRecording(path("live.mcap"));
            return recording && recording->branches[0].timeline.last() == tick;
        }));
    }
    void reload() {
        window.messages().clear();
        QTest::keyClick(&window, Qt::Key_F5);
        settle();
    }
    MainWindow other_;
};

TEST_F(GrowingTest, SaysSoAndIsReadOn) {
    EXPECT_THAT(notes(), ElementsAre(AllOf(HasSubstr("is still being written"), HasSubstr(": 1.8 s"), HasSubstr("F5"),
                                           testing::Not(HasSubstr("cut off")))));
    seek(50);
    reload();
    EXPECT_THAT(notes(), ElementsAre(HasSubstr("Nothing has changed: live.mcap")));
    EXPECT_EQ(window.shown()->branches.size(), 1u);
    growTo(200);
    reload();
    EXPECT_THAT(notes(), ElementsAre(HasSubstr("is still being written"), HasSubstr("goes up to 4.00 s now")));
    EXPECT_EQ(window.shown()->branches.size(), 1u);
    EXPECT_EQ(window.shown()->last, 200);
    EXPECT_EQ(state().tick, 50);
    seek(200);
    EXPECT_EQ(window.shown()->hash, hashAt(*scenarioOf(path("game.toml")), 200));
    // Where one looks stays.
    window.field().setSelected(1);
    window.field().viewport().zoom(2.5);
    const ViewTransform view = window.field().transform();
    // And to its end.
    other_.session().seek(210);
    other_.session().settle();  // the next request would end it on its way
    other_.files().saver().record({});
    other_.session().settle();
    reload();
    EXPECT_THAT(notes(), ElementsAre(HasSubstr("goes up to 4.20 s now")));
    EXPECT_EQ(window.field().transform().scale(), view.scale());
    EXPECT_EQ(window.field().transform().centre().x, view.centre().x);
    EXPECT_EQ(window.field().selected(), 1u);
}

TEST_F(GrowingTest, AsksBeforeWorkIsLeftForWhatWasWrittenSince) {
    throwBall();
    int questions = 0;
    window.files().saver().setQuestion([&](const QString&) {
        ++questions;
        return RunSaver::Answer::cancel;
    });
    reload();
    EXPECT_EQ(questions, 0);
    growTo(120);
    reload();
    EXPECT_EQ(questions, 1);
    EXPECT_EQ(window.shown()->branches.size(), 2u);
}

TEST_F(GrowingTest, RecordingThatIsEmptiedOrRemovedIsSaid) {
    for (const bool removed : {false, true}) {
        open(path("live.mcap"));
        std::filesystem::copy_file(path("live.mcap"), path("kept.mcap"));
        window.messages().clear();
        if (removed)
            std::filesystem::remove(path("live.mcap"));
        else
            std::filesystem::resize_file(path("live.mcap"), 0);
        ASSERT_TRUE(waitFor([&] { return !notes().empty(); }));
        EXPECT_THAT(notes(),
                    ElementsAre(AllOf(HasSubstr("live.mcap was removed or emptied"), HasSubstr("can be saved"))));
        EXPECT_EQ(window.shown()->last, 90);
        std::filesystem::rename(path("kept.mcap"), path("live.mcap"));
        EXPECT_TRUE(waitFor([&] { return notes().empty(); })) << "it is back";
    }
    ASSERT_TRUE(window.actions().perform("save_recording", qPath("live.mcap")));
}

}  // namespace
}  // namespace mrose::gui
