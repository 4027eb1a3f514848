// The session carries out what it is asked in order, and ends what takes long where it is told to.
#include <future>

#include <gmock/gmock.h>

#include "files/window_files.h"
#include "gui/window_fixture.h"
#include "io/file.h"
#include "support/full_disk.h"
#include "support/temporary_folder.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"
#include "workflow/open_run.h"

namespace mrose::gui {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class SessionTest : public WindowTest {
protected:
    /// Keeps the session at work until it is let go.
    class Held {
    public:
        explicit Held(Session& session) {
            session.doLongWork("held",
                               [until = gate_.get_future().share()](TimeTravel&, const Progress&) { until.wait(); });
        }
        void letGo() { gate_.set_value(); }

    private:
        std::promise<void> gate_;
    };
    static bool waitFor(const std::function<bool()>& holds) { return QTest::qWaitFor(holds, 60'000); }
    Session& session() { return window.session(); }
};

TEST_F(SessionTest, SeekHasItsTurn) {
    session().seek(100, false);
    settle();
    Held held(session());
    session().seek(30, false);
    session().seek(60, false);
    session().branchOff({"mine"});
    session().seek(80, false);
    held.letGo();
    settle();
    EXPECT_EQ(window.shown()->branches.back().departed, 60);
    EXPECT_EQ(window.shown()->tick(), 80);
}

TEST_F(SessionTest, WhatWasAskedOfTheRunBeforeIsNotDoneInTheNext) {
    Breakpoint late;
    late.text = "tick >= 50";
    session().setBreakpoints({late});
    session().goToBreak({});
    settle();
    ASSERT_TRUE(window.shown()->atBreak);
    Held held(session());
    session().seek(400, false);
    const std::uint64_t before = window.shown()->run;
    ASSERT_TRUE(window.open("b21_corridor.toml"));
    held.letGo();
    settle();
    EXPECT_EQ(window.shown()->run, before + 1);
    EXPECT_EQ(window.shown()->tick(), 0);
    EXPECT_FALSE(window.shown()->atBreak);
}

TEST_F(SessionTest, AnotherRunEndsWhatTakesLongButNotASave) {
    session().ask([=](Debugger& debugger) { debugger.stopAt(2'000'000'000); });
    session().goToBreak({});
    ASSERT_TRUE(waitFor([&] { return window.shown()->tick() > 100; }));
    std::vector<bool> wentOn;
    for (const bool finishes : {false, true})
        session().doLongWork(
            "work", [&](TimeTravel&, const Progress& progress) { wentOn.push_back(progress(0)); }, finishes);
    const std::uint64_t before = window.shown()->run;
    ASSERT_TRUE(window.open("b21_corridor.toml"));
    EXPECT_TRUE(waitFor([&] { return window.shown()->run != before; }));
    EXPECT_THAT(wentOn, ElementsAre(false, true));
    EXPECT_EQ(window.shown()->tick(), 0);
}

TEST_F(SessionTest, RunToABreakIsToldAllTheWayAndEscapeEndsItFirst) {
    session().ask([=](Debugger& debugger) { debugger.stopAt(2'000'000'000); });
    session().goToBreak({});
    ASSERT_TRUE(waitFor([&] { return window.messages().has("work"); }));
    int updates = 0, told = 0;
    QObject::connect(&window.session(), &Session::shown, &window.messages(), [&] {
        ++updates;
        told += window.messages().has("work") ? 1 : 0;
    });
    ASSERT_TRUE(waitFor([&] { return updates >= 10; }));
    EXPECT_EQ(told, updates);
    window.messages().add({MessageBar::Kind::note, "a bystander", "bystander"});
    QTest::keyClick(&window, Qt::Key_Escape);
    settle();
    settle();
    EXPECT_EQ(window.shown()->message, "Ended before a break was found");
    EXPECT_FALSE(window.messages().has("work"));
    EXPECT_TRUE(window.messages().has("bystander"));
    EXPECT_FALSE(session().cancel());
    QTest::keyClick(&window, Qt::Key_Escape);
    EXPECT_FALSE(window.messages().has("bystander"));
}

std::vector<std::string> warnings;

/// The session is gone before anybody could be told.
TEST_F(SessionTest, RecordingThatFailsAtTheVeryEndIsSaid) {
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "kept.mcap").string();
    auto alone = std::make_unique<Session>();
    alone->open(*openRun({"soccer.toml"}));
    alone->record(qtText(file), "", false);
    alone->settle();
    warnings.clear();
    const auto before = qInstallMessageHandler(
        [](QtMsgType, const QMessageLogContext&, const QString& text) { warnings.push_back(text.toStdString()); });
    {
        const FullDisk full(std::filesystem::file_size(file));
        alone.reset();
    }
    qInstallMessageHandler(before);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("kept.mcap")));
}

}  // namespace
}  // namespace mrose::gui
