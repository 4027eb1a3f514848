// Runs are opened, opened again when a description changes, saved and recorded.
#include "io/file.h"

#include <QApplication>
#include <QDockWidget>
#include <QFileDialog>
#include <QScreen>
#include <QSettings>
#include <QTableWidget>
#include <QTimer>
#include <csignal>
#include <filesystem>

#include <gmock/gmock.h>

#include "files/window_files.h"
#include "frame/window_memory.h"
#include "gui/file_fixture.h"
#include "recording/recording.h"
#include "scenario/scenario_file.h"
#include "scenario/variation.h"
#include "support/places.h"
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

TEST_F(FileTest, DroppedScenarioStandsAtItsStart) {
    const std::string file = writeGame();
    dropFile(file);
    settle();
    ASSERT_NE(window.shown(), nullptr);
    EXPECT_EQ(window.shown()->hash, hashAt(*scenarioOf(file), 0));
    EXPECT_EQ(window.windowTitle().toStdString().find("a game"), 0u);
    EXPECT_THAT(errors(), IsEmpty());
}

TEST_F(FileTest, OpensWhatShipsByItsName) {
    open("b21_corridor.toml");
    ASSERT_NE(window.shown(), nullptr);
    EXPECT_FALSE(window.shown()->frame->state.robots.empty());
}

TEST_F(FileTest, OpeningDoesNotHoldUpTheWindowAndALaterOneTakesItsPlace) {
    const std::string file = writeGame();
    write("other.toml", game(0.5));
    std::vector<std::string> titles;
    QObject::connect(&window, &QWidget::windowTitleChanged,
                     [&](const QString& title) { titles.push_back(title.toStdString()); });
    int shown = 0;
    QObject::connect(&window.session(), &Session::shown, [&] { ++shown; });
    window.files().open(qtText(file));
    EXPECT_TRUE(window.files().opener().busy());
    EXPECT_EQ(shown, 0);
    window.files().open(qPath("other.toml"));
    settle();
    EXPECT_EQ(titles.size(), 1u);
    EXPECT_EQ(window.shown()->hash, hashAt(*scenarioOf(path("other.toml")), 0));
}

TEST_F(FileTest, EscapeEndsAnOpening) {
    open(writeGame());
    const StateHash before = window.shown()->hash;
    write("other.toml", game(0.5));
    window.files().open(qPath("other.toml"));
    QTest::keyClick(&window, Qt::Key_Escape);
    EXPECT_FALSE(window.files().opener().busy());
    settle();
    EXPECT_EQ(window.shown()->hash, before);
    EXPECT_EQ(window.files().opened()->file, path("game.toml"));
}

/// The tick that matters of a trial, as `mrose run` has it.
TEST_F(FileTest, OpensATrialAtAnInstantAsTheProgramRunsIt) {
    const std::string file = writeGame();
    const ProgramResult alone = runMrose({"run", file, "--trial", "3", "--seed", "9", "--duration", "3.42", "--quiet"});
    ASSERT_EQ(alone.status, 0) << alone.err;
    ASSERT_TRUE(window.files().openNow({file, 3, 9}, 3.42));
    settle();
    EXPECT_EQ(state().tick, 171);
    char hash[40];
    std::snprintf(hash, sizeof hash, "state %016llx\n", static_cast<unsigned long long>(window.shown()->hash.world));
    EXPECT_THAT(alone.out, HasSubstr(hash));
    EXPECT_THAT(window.windowTitle().toStdString(), HasSubstr("trial 3"));
}

/// Friction and masses of a trial are no part of a recording's states; in this one the ball is kicked.
TEST_F(FileTest, RecordedTrialIsTheTrial) {
    const std::string file = writeGame();
    ASSERT_EQ(
        runMrose({"run", file, "--trial", "2", "--duration", "10", "--record", path("trial.mcap"), "--quiet"}).status,
        0);
    const ProgramResult replayed = runMrose({"replay", path("trial.mcap"), "--decide"});
    EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
    ASSERT_TRUE(window.files().openNow({file, 2}, 9.0));
    settle();
    const StateHash trial = window.shown()->hash;
    open(path("trial.mcap"), 9.0);
    EXPECT_EQ(window.shown()->hash, trial);
    EXPECT_NE(trial, hashAt(*scenarioOf(file), 450));
}

TEST_F(FileTest, OpensARecordingAtAnInstantAndGoesNoFurtherThanItGoes) {
    const std::string file = writeGame(), recording = path("game.mcap");
    ASSERT_EQ(runMrose({"run", file, "--record", recording, "--quiet"}).status, 0);
    const auto scenario = scenarioOf(file);
    open(recording, 1.5);
    EXPECT_EQ(window.shown()->hash, hashAt(*scenario, 75));
    EXPECT_EQ(window.shown()->last, 150);
    EXPECT_THAT(notes(), IsEmpty());
    open(recording, 30.0);
    EXPECT_EQ(window.shown()->hash, hashAt(*scenario, 150));
    EXPECT_THAT(notes(), ElementsAre(HasSubstr("ends at 3.00 s")));
    // And on from there, as if it had not been recorded.
    seek(200);
    EXPECT_EQ(window.shown()->hash, hashAt(*scenario, 200));
}

TEST_F(FileTest, InstantBeyondTheScenariosEndIsSimulatedAndSaid) {
    const std::string file = writeGame();
    open(file, 2.0);
    EXPECT_THAT(notes(), IsEmpty());
    open(file, 5.0);
    EXPECT_EQ(window.shown()->hash, hashAt(*scenarioOf(file), 250));
    EXPECT_THAT(notes(), ElementsAre(AllOf(HasSubstr("ends at 3.00 s"), HasSubstr("5.00 s"))));
}

TEST_F(FileTest, RunWithBranchesIsSavedAndOpenedAgain) {
    open(writeGame());
    seek(100);
    throwBall();
    seek(140);
    const StateHash thrown = window.shown()->hash;
    ASSERT_TRUE(window.actions().perform("save_recording", qPath("saved.mcap")));
    ASSERT_TRUE(waitFor([&] { return !notes().empty(); }));
    EXPECT_THAT(notes(), ElementsAre("Saved " + path("saved.mcap")));
    EXPECT_FALSE(window.files().saver().hasUnsaved());
    const ProgramResult replayed = runMrose({"replay", path("saved.mcap"), "--decide"});
    EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
    EXPECT_THAT(replayed.out, HasSubstr("the same to the last bit"));

    open(path("saved.mcap"));
    ASSERT_EQ(window.shown()->branches.size(), 2u);
    EXPECT_EQ(window.shown()->branches[1].name, "thrown");
    EXPECT_FALSE(window.files().saver().hasUnsaved());
    // Where it was saved.
    EXPECT_EQ(window.shown()->branch, 1u);
    EXPECT_EQ(state().tick, 140);
    EXPECT_EQ(window.shown()->hash, thrown);
    EXPECT_THAT(notes(), ElementsAre(AllOf(HasSubstr("and 1 branch of it"), HasSubstr("\u201cthrown\u201d"))));
    ASSERT_TRUE(press("Show the run"));
    settle();
    EXPECT_EQ(window.shown()->branch, 0u);
    EXPECT_EQ(state().tick, 140);

    // At an instant that is asked for it is the run, and what was tried last is offered.
    open(path("saved.mcap"), 0.0);
    const std::vector<MessageBar::Message> said = window.messages().messages();
    ASSERT_EQ(said.size(), 1u);
    EXPECT_TRUE(said[0].buttons.size() == 1 && said[0].buttons[0].text.contains("thrown"));
    EXPECT_EQ(window.shown()->branch, 0u);
    said[0].buttons[0].run();
    settle();
    EXPECT_EQ(window.shown()->branch, 1u);
    EXPECT_EQ(window.shown()->tick(), 100);
    EXPECT_TRUE(window.messages().messages().empty());
}

TEST_F(FileTest, SavedStateGoesOnAsTheRunWould) {
    open(writeGame());
    seek(70);
    throwBall();
    seek(90);
    ASSERT_TRUE(window.actions().perform("save_scenario", qPath("later.toml")));
    ASSERT_TRUE(waitFor([&] { return !notes().empty(); }));
    EXPECT_THAT(notes(), ElementsAre(HasSubstr("later.toml")));
    const StateHash then = window.shown()->hash;
    seek(130);
    const StateHash later = window.shown()->hash;
    open(path("later.toml"));
    EXPECT_EQ(state().tick, 90);
    EXPECT_EQ(window.shown()->hash, then);
    seek(130);
    EXPECT_EQ(window.shown()->hash, later);
    // Not over what the run is made from.
    EXPECT_FALSE(window.actions().perform("save_scenario", qPath("later.toml")));
}

TEST_F(FileTest, RecordsFromTheStartWhereverItBegins) {
    open(writeGame());
    seek(60);
    ASSERT_TRUE(window.actions().perform("record_to", qPath("kept.mcap")));
    settle();
    EXPECT_TRUE(action("stop_recording").isEnabled());
    EXPECT_EQ(window.files().saver().recordedTo(), qPath("kept.mcap"));
    seek(100);
    throwBall();
    seek(130);
    action("stop_recording").trigger();
    settle();
    EXPECT_FALSE(action("stop_recording").isEnabled());
    EXPECT_THAT(notes(), ElementsAre("Recorded in " + path("kept.mcap")));
    const auto recording = openRecording(path("kept.mcap"));
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_THAT(recording->damage, IsEmpty());
    ASSERT_EQ(recording->branches.size(), 2u);
    EXPECT_EQ(recording->branches[0].timeline.first(), 0);
    EXPECT_GE(recording->branches[0].timeline.last(), 100);
    EXPECT_EQ(recording->branches[1].timeline.last(), 130);
    const ProgramResult replayed = runMrose({"replay", path("kept.mcap"), "--decide"});
    EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
}

/// What is written so far is of use at any moment.
TEST_F(FileTest, RecordingUnderWayCanBeOpened) {
    open(writeGame());
    window.files().saver().record(qPath("growing.mcap"));
    seek(90);
    const auto ticks = [&] {
        const auto recording = openRecording(path("growing.mcap"));
        return recording ? recording->branches[0].timeline.last() : -1;
    };
    EXPECT_TRUE(waitFor([&] { return ticks() == 90; }));
}

TEST_F(FileTest, RunsOfABatchAreListedAndOpenedWhereTheyEnded) {
    const std::string file = writeGame();
    ASSERT_EQ(runMrose({"batch", file, "--trials", "3", "--seeds", "4..5", "--until", "ball.speed > 0.2", "--quiet",
                        "-o", path("out")})
                  .status,
              0);
    dropFile(path("out/results.csv"));
    settle();
    auto* list = window.findChild<QTableWidget*>();
    ASSERT_NE(list, nullptr);
    ASSERT_EQ(list->rowCount(), 6);
    QStringList titles;
    for (int column = 0; column < list->columnCount(); ++column) {
        titles << list->horizontalHeaderItem(column)->text();
        EXPECT_GE(list->columnWidth(column), list->fontMetrics().horizontalAdvance(titles.back()) + 12);
    }
    EXPECT_TRUE(titles.contains("Time (s)") && titles.contains("Driven (m)") && titles.contains("Ball still (s)"))
        << titles.join(", ").toStdString();
    list->sortItems(3, Qt::DescendingOrder);
    const std::string trial = list->item(0, 0)->text().toStdString(), seed = list->item(0, 1)->text().toStdString();
    const std::string end = list->item(0, 3)->text().toStdString();
    emit list->cellActivated(0, 0);
    settle();
    const ProgramResult alone = runMrose({"run", file, "--trial", trial, "--seed", seed, "--duration", end, "--quiet"});
    char hash[40];
    std::snprintf(hash, sizeof hash, "state %016llx\n", static_cast<unsigned long long>(window.shown()->hash.world));
    EXPECT_THAT(alone.out, HasSubstr(hash));
    write("cut.csv", "trial,seed,end,time_s,touches,kicks,hits,faults,driven_m,command\n1,2\n");
    dropFile(path("cut.csv"));
    settle();
    EXPECT_THAT(errors(), ElementsAre(HasSubstr("cut.csv:2")));
}

/// A kill loses no more than the last second.
TEST_F(FileTest, RecordingOutlivesAKill) {
    const std::string file = writeGame(), recording = path("killed.mcap");
    RunningProgram program({mroseProgram() + "-gui", "--offscreen", "--run", file, "--duration", "100000", "--speed",
                            "20", "--record", recording});
    const auto ticks = [&] {
        const auto kept = openRecording(recording);
        return kept ? kept->branches[0].timeline.last() : -1;
    };
    EXPECT_TRUE(waitFor([&] { return ticks() > 300; }));
    program.send(SIGKILL);
    program.finish();
    EXPECT_GT(ticks(), 300);
    const ProgramResult replayed = runMrose({"replay", recording, "--decide"});
    EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
}

TEST_F(FileTest, EscapeEndsALongWayToATick) {
    open(writeGame());
    window.session().seek(100'000'000);
    const auto said = [&](const std::string& text) {
        const std::vector<std::string> lines = this->said(MessageBar::Kind::progress);
        return lines.size() == 1 && lines[0].find(text) != text.npos;
    };
    ASSERT_TRUE(waitFor([&] { return said("Simulating up to 2000000.00 s"); }));
    QTest::keyClick(&window, Qt::Key_Escape);
    ASSERT_TRUE(waitFor([&] { return !window.session().busy(); }));
    QApplication::processEvents();
    EXPECT_LT(state().tick, 100'000'000);
    EXPECT_THAT(this->said(MessageBar::Kind::progress), IsEmpty());
}

class UnsavedTest : public FileTest {
protected:
    void SetUp() override {
        open(writeGame());
        seek(50);
        throwBall();
        write("other.toml", game(0.5));
        window.files().saver().setQuestion([this](const QString& what) {
            questions_.push_back(what.toStdString());
            return answer_;
        });
    }
    RunSaver::Answer answer_ = RunSaver::Answer::cancel;
    std::vector<std::string> questions_;
};

TEST_F(UnsavedTest, BranchesAreAskedAboutBeforeTheyGo) {
    window.files().open(qPath("other.toml"));
    settle();
    EXPECT_EQ(questions_.size(), 1u);
    EXPECT_EQ(window.shown()->branches.size(), 2u);
    window.close();
    EXPECT_TRUE(window.isVisible());
    EXPECT_EQ(questions_.size(), 2u);
    answer_ = RunSaver::Answer::discard;
    window.files().open(qPath("other.toml"));
    settle();
    EXPECT_EQ(window.shown()->branches.size(), 1u);
    window.close();
    EXPECT_FALSE(window.isVisible());
    EXPECT_EQ(questions_.size(), 3u);
}

/// Types a name into the next file dialogue.
void answerFileDialogue(const QString& path) {
    QTimer::singleShot(0, [path] {
        auto* dialogue = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
        if (dialogue == nullptr) return answerFileDialogue(path);
        dialogue->selectFile(path);
        QMetaObject::invokeMethod(dialogue, "accept");
    });
}

TEST_F(UnsavedTest, SavingComesFirstAndThenWhatWasAskedFor) {
    answer_ = RunSaver::Answer::save;
    answerFileDialogue(qPath("saved.mcap"));
    window.files().open(qPath("other.toml"));
    ASSERT_TRUE(waitFor([&] { return window.files().opened()->file == path("other.toml"); }));
    EXPECT_EQ(questions_.size(), 1u);
    const auto saved = openRecording(path("saved.mcap"));
    ASSERT_TRUE(saved) << saved.error().message();
    EXPECT_EQ(saved->branches.size(), 2u);
}

TEST_F(UnsavedTest, UnattendedRunsAskNoQuestion) {
    window.actions().setUnattended(true);
    ASSERT_TRUE(window.actions().perform("open", qPath("other.toml")));
    settle();
    EXPECT_EQ(window.shown()->branches.size(), 1u);
    EXPECT_THAT(questions_, IsEmpty());
}

std::unique_ptr<QSettings> settingsIn(const QString& file) {
    return std::make_unique<QSettings>(file, QSettings::IniFormat);
}

TEST_F(FileTest, RecentFilesOutliveTheWindow) {
    const std::string file = writeGame();
    write("other.toml", game(0.5));
    MainWindow other;
    window.frame().memory.restore(settingsIn(qPath("settings.ini")));
    other.frame().memory.restore(settingsIn(qPath("settings.ini")));
    open(file);
    ASSERT_TRUE(other.files().openNow({path("other.toml")}));
    EXPECT_THAT(other.frame().memory.recentFiles(), ElementsAre(qPath("other.toml"), qPath("game.toml")));
    MainWindow later;
    later.frame().memory.restore(settingsIn(qPath("settings.ini")));
    EXPECT_THAT(later.frame().memory.recentFiles(), ElementsAre(qPath("other.toml"), qPath("game.toml")));
    // One that is gone is forgotten when it is asked for.
    std::filesystem::remove(path("other.toml"));
    EXPECT_FALSE(later.files().openNow({path("other.toml")}));
    EXPECT_THAT(later.frame().memory.recentFiles(), ElementsAre(qPath("game.toml")));
}

TEST_F(FileTest, LayoutOutlivesTheWindowAndIsReset) {
    window.frame().memory.restore(settingsIn(qPath("settings.ini")));
    auto* dock = window.findChild<QDockWidget*>("branches");
    ASSERT_NE(dock, nullptr);
    ASSERT_TRUE(dock->isVisible());
    dock->hide();
    window.resize(1000, 700);
    action("dark").trigger();
    action("layer_names").trigger();
    window.close();

    MainWindow later;
    later.frame().memory.restore(settingsIn(qPath("settings.ini")));
    later.QWidget::show();
    EXPECT_FALSE(later.findChild<QDockWidget*>("branches")->isVisible());
    EXPECT_EQ(later.size(), QSize(1000, 700));
    EXPECT_TRUE(later.actions()["dark"].isChecked());
    EXPECT_FALSE(later.field().layers().has(FieldLayer::names));
    later.actions()["reset_layout"].trigger();
    EXPECT_TRUE(later.findChild<QDockWidget*>("branches")->isVisible());
    const QSize room = QGuiApplication::primaryScreen()->availableSize();
    EXPECT_LT(later.frameGeometry().width(), room.width());
    EXPECT_LT(later.frameGeometry().height(), room.height());

    MainWindow fresh;  // without settings, as scripts have it
    fresh.QWidget::show();
    EXPECT_TRUE(fresh.findChild<QDockWidget*>("branches")->isVisible());
    EXPECT_FALSE(fresh.actions()["dark"].isChecked());
    action("dark").trigger();
}

}  // namespace
}  // namespace mrose::gui
