// Any log that can be read opens from the window: short pieces, one's own CSV, and what cannot be opened leaves all as
// it is.
#include <QApplication>
#include <QHeaderView>
#include <QLabel>
#include <QListWidget>
#include <QScrollBar>
#include <QSettings>
#include <QTest>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "assessment/evaluate.h"
#include "assessment/windows.h"
#include "files/window_files.h"
#include "frame/window_memory.h"
#include "gui/overlay_fixture.h"
#include "io/file.h"
#include "io/format.h"
#include "logs/log_reader.h"
#include "motion/learned_model.h"
#include "reality/robot_dialog.h"
#include "scripting/window_script.h"
#include "support/mrclam_folder.h"
#include "support/places.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"
#include "workflow/resources.h"
#include "world/state_hash.h"

namespace mrose::gui {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class LogOpeningTest : public OverlayTest {
protected:
    /// Windows of 1.95 s as of a Husky, each on a straight line, at speeds of their own.
    std::string huskyLog(int count) const {
        std::string text =
            "window,calib_step,t_s,cmd_left_radps,cmd_right_radps,wheel_left_radps,wheel_right_radps,icp_x_m,icp_y_m,"
            "icp_yaw_rad,imu_yaw_rad,steady\n";
        for (int i = 0; i < count; ++i)
            for (int row = 0; row < 40; ++row) {
                const double t = 0.05 * row, wheels = 3 + 0.1 * i, x = 0.165 * wheels * t;
                for (const double cell : {1.0 * i, 1.0 * i, t, wheels, wheels, wheels, wheels, x, 0.0, 0.0})
                    text += numberText(cell) + ',';
                text += "0,1\n";
            }
        return write("husky.csv", text);
    }
    /// A log of the user's own robot.
    std::string ownLog(const std::string& name = "own.csv") {
        makeLog([](Log& log) { log.synthetic = false; });
        return write(name, readFile(path("made.csv")).value_or(""));
    }
    RobotDialog* dialog() const { return window.findChild<RobotDialog*>(); }
    std::string head() const {
        std::string all;
        for (const QLabel* label : panel.findChildren<QLabel*>()) all += label->text().toStdString() + '\n';
        return all;
    }
    void dropAndSettle(const std::string& file) {
        dropFile(file);
        QApplication::processEvents();
        settleAll();
    }
    void remember() {
        window.frame().memory.restore(std::make_unique<QSettings>(qPath("kept.ini"), QSettings::IniFormat));
    }

    /// All that a user sees of a log and its run.
    struct State {
        PlayedLogPointer world;
        RolloutPlan plan;
        std::size_t rollouts = 0, rows = 0, models = 0;
        std::optional<std::size_t> rollout;
        std::uint64_t run = 0;
        std::int64_t tick = 0;
        StateHash hash;
        std::size_t branches = 0, breakpoints = 0;
        const Comparison* comparison = nullptr;
        const Reality* reality = nullptr;
        bool operator==(const State&) const = default;
    };
    State now() const {
        const Shown& shown = *window.shown();
        return {overlay.rollouts().log(),
                overlay.rollouts().plan(),
                overlay.rollouts().requests().size(),
                overlay.rollouts().rows().size(),
                overlay.models().all().size(),
                overlay.rollouts().shown(),
                shown.run,
                shown.tick(),
                hashOf(shown.frame->state),
                shown.branches.size(),
                shown.breakpoints.size(),
                overlay.rollouts().comparison(),
                shown.frame->reality.get()};
    }
    /// The shipped log in its third rollout, with a branch, a breakpoint and a second model.
    void work() {
        openLog(shipped());
        overlay.shown().show(2);
        overlay.models().add("velocity = command");
        settleAll();
        seek(40);
        window.session().branchOff({"mine"});
        Breakpoint breakpoint;
        breakpoint.text = "time > 300";
        window.session().changeBreakpoints([=](Breakpoints& all) { all.add(breakpoint); });
        settleAll();
    }
};

TEST_F(LogOpeningTest, ShortTrajectoriesAreCutAsEvaluateCutsThem) {
    const std::string file = huskyLog(6);
    dropAndSettle(file);
    EXPECT_THAT(errors(), IsEmpty());
    ASSERT_TRUE(overlay.rollouts().log());
    EXPECT_EQ(overlay.rollouts().plan(), (RolloutPlan{RolloutPlan::Cut::windows, 0, 1.9}));
    const auto log = readLog(file);
    ASSERT_TRUE(log);
    const auto windows = findWindows(*log);
    ASSERT_TRUE(windows);
    ASSERT_EQ(overlay.rollouts().requests().size(), windows->size());
    for (std::size_t i = 0; i < windows->size(); ++i) {
        const RolloutRequest& request = overlay.rollouts().requests()[i];
        const LogSession::Part& part = overlay.rollouts().world().sessions()[request.session].parts[0];
        EXPECT_EQ(part.trajectory, (*windows)[i].trajectory);
        EXPECT_EQ(part.origin + request.start, (*windows)[i].start);
        EXPECT_EQ(request.steps, (*windows)[i].steps());
    }
    EXPECT_THAT(notes(), Contains(HasSubstr("windows of 1.9 s, as mrose evaluate cuts them")));
    EXPECT_EQ(overlay.rollouts().shown(), 0u);
    ASSERT_TRUE(overlay.setPlan({RolloutPlan::Cut::windows, 0, 1}));
    settleAll();
    EXPECT_THAT(notes(), Not(Contains(HasSubstr("as mrose evaluate cuts them")))) << "it is no longer so";
}

TEST_F(LogOpeningTest, PanelOfALogInPiecesTellsThemApart) {
    ASSERT_NO_FATAL_FAILURE(openLog(huskyLog(6)));
    EXPECT_EQ(overlay.rollouts().world().robots()[0].name, "husky");
    // Six times 1.95 s.
    EXPECT_THAT(head(), HasSubstr("6 rollouts of 1 robot, 6 sessions, 0:11.7 in all"));
    const QTreeView& list = panel.list();
    EXPECT_TRUE(list.isColumnHidden(RolloutList::robot));
    ASSERT_FALSE(list.isColumnHidden(RolloutList::session));
    list.model()->sort(RolloutList::session, Qt::AscendingOrder);
    for (int line = 0; line < 6; ++line)
        EXPECT_EQ(list.model()->index(line, RolloutList::session).data().toString(), QString::number(line));
    overlay.shown().show(4, 0);
    settleAll();
    EXPECT_THAT(panel.causes().text().toStdString(), HasSubstr("husky in session 4 from"));
    EXPECT_THAT(window.windowTitle().toStdString(), HasSubstr("session 4"));
    const std::string whole = makeLog([](Log& log) { log.robots[0].trajectories.resize(1); });
    ASSERT_NO_FATAL_FAILURE(openLog(whole, {RolloutPlan::Cut::every, 0, 2}));
    EXPECT_FALSE(list.isColumnHidden(RolloutList::robot));
    EXPECT_TRUE(list.isColumnHidden(RolloutList::session));
    EXPECT_THAT(head(), Not(HasSubstr("sessions")));
}

TEST_F(LogOpeningTest, PlanThatIsAskedForIsKept) {
    const std::string file = huskyLog(6);
    EXPECT_THAT(refusal({file, ""}, RolloutPlan{}), HasSubstr("no rollout of 10.0 s fits in"));
    EXPECT_FALSE(overlay.rollouts().log());
    EXPECT_EQ(refusal({file, ""}, RolloutPlan{RolloutPlan::Cut::every, 0, 0.5}), "");
    EXPECT_EQ(overlay.rollouts().plan().cut, RolloutPlan::Cut::every);
    EXPECT_EQ(overlay.rollouts().requests().size(), 6u * 3);
    EXPECT_THAT(notes(), Not(Contains(HasSubstr("are short"))));
}

TEST_F(LogOpeningTest, RobotThatStandsOpensToo) {
    const std::string file = makeLog([](Log& log) {
        for (Trajectory& trajectory : log.robots[0].trajectories) {
            trajectory.poses.resize(200);
            for (StampedPose& stamped : trajectory.poses) stamped.pose = {1, 2, 0.5};
            trajectory.commands = {{trajectory.poses.front().time, {0, 0}}, {trajectory.poses[9].time, {0, 0}}};
        }
    });
    ASSERT_NO_FATAL_FAILURE(openLog(file));
    EXPECT_EQ(overlay.rollouts().plan().cut, RolloutPlan::Cut::every);
    EXPECT_THAT(overlay.rollouts().rows(), Not(IsEmpty()));
    EXPECT_THAT(notes(), Contains(HasSubstr("starts again every")));
}

TEST_F(LogOpeningTest, SingleCommandIsEnough) {
    const std::string file = makeLog([](Log& log) {
        for (Trajectory& trajectory : log.robots[0].trajectories) trajectory.commands.resize(1);
    });
    ASSERT_NO_FATAL_FAILURE(openLog(file));
    ASSERT_TRUE(overlay.rollouts().shown());
    EXPECT_THAT(errors(), IsEmpty());
    seek(100);
    EXPECT_EQ(window.shown()->tick(), 100);
}

TEST_F(LogOpeningTest, NetworkOfAnotherKindOfRobotSaysSo) {
    ASSERT_NO_FATAL_FAILURE(openLog(makeLog()));
    overlay.models().add("create.net");
    settleAll();
    ASSERT_EQ(overlay.models().all().size(), 2u);
    EXPECT_THAT(notes(), Contains(HasSubstr("another kind of robot (irobot-create)")));
}

TEST_F(LogOpeningTest, WhatDroveInOnesOwnLogIsAsked) {
    remember();
    const std::string file = ownLog();
    dropAndSettle(file);
    EXPECT_THAT(errors(), IsEmpty());
    EXPECT_FALSE(overlay.rollouts().log());
    ASSERT_NE(dialog(), nullptr);
    ASSERT_TRUE(dialog()->isVisible());
    QListWidget& robots = dialog()->robots();
    QStringList texts;
    for (int i = 0; i < robots.count(); ++i) {
        texts << robots.item(i)->text();
        EXPECT_FALSE(robots.item(i)->icon().isNull());
    }
    EXPECT_THAT(texts.join('\n').toStdString(), HasSubstr("Husky\n0.99 \u00d7 0.67 m, learned motion, dead time"));
    // By keys alone: to the Pioneer, and open.
    EXPECT_TRUE(robots.hasFocus());
    while (!robots.currentItem()->text().startsWith("Pioneer")) {
        const int row = robots.currentRow();
        QTest::keyClick(&robots, Qt::Key_Down);
        ASSERT_EQ(robots.currentRow(), row + 1);
    }
    QTest::keyClick(&robots, Qt::Key_Return);
    settleAll();
    EXPECT_THAT(errors(), IsEmpty());
    ASSERT_TRUE(overlay.rollouts().log());
    EXPECT_EQ(overlay.rollouts().log()->request.robotFile, "pioneer1.toml");
    EXPECT_EQ(overlay.rollouts().world().parts().scene.typeOf(0).name, "Pioneer 1");
    EXPECT_EQ(overlay.rollouts().shown(), 0u);
    EXPECT_THAT(window.frame().memory.recentFiles(), Contains(qtText(file)));
    // Once more: what was said stands ready.
    overlay.close();
    dropAndSettle(file);
    ASSERT_NE(dialog(), nullptr);
    EXPECT_TRUE(dialog()->robots().currentItem()->text().startsWith("Pioneer"));
    QTest::keyClick(&dialog()->robots(), Qt::Key_Return);
    settleAll();
    EXPECT_TRUE(overlay.rollouts().log());
}

TEST_F(LogOpeningTest, WhatCannotBeComparedIsRefusedBeforeItIsAskedWhatDrove) {
    const auto opened = [&](const std::function<void(Trajectory&)>& change) {
        window.messages().clear();
        makeLog([&](Log& log) {
            log.synthetic = false;
            for (Trajectory& trajectory : log.robots[0].trajectories) change(trajectory);
        });
        dropAndSettle(path("made.csv"));
        EXPECT_EQ(dialog(), nullptr);
        EXPECT_FALSE(overlay.rollouts().log());
        return errors();
    };
    EXPECT_THAT(opened([](Trajectory& trajectory) {
                    for (StampedPose& stamped : trajectory.poses) stamped.time += 1000 * nanosecondsPerSecond;
                }),
                ElementsAre(HasSubstr("expected both of the same time")));
    EXPECT_THAT(opened([](Trajectory& trajectory) {
                    for (StampedPose& stamped : trajectory.poses) stamped.pose.x = 3000 * (1 + stamped.pose.x);
                }),
                ElementsAre(HasSubstr("positions are expected in metres")));
}

TEST_F(LogOpeningTest, EmptyTruthOfOneRobotIsSaidAndTheOthersOpen) {
    const MrclamFolder folder(3);
    folder.write(2, "Groundtruth", "");
    ASSERT_NO_FATAL_FAILURE(openLog(folder.path()));
    EXPECT_EQ(overlay.rollouts().world().robots().size(), 2u);
    EXPECT_THAT(errors(), IsEmpty());
    EXPECT_THAT(notes(), Contains(HasSubstr("Robot2_Groundtruth.dat has no rows: nothing says where robot 2 was.")));
    EXPECT_THAT(notes(), Contains(HasSubstr("Robot \"2\" is not compared: the log has no ground truth of it.")));
    // So it is with a scenario of five.
    EXPECT_THAT(refusal({folder.path(), "mrclam_replay.toml"}), IsEmpty());
    settleAll();
    EXPECT_EQ(overlay.rollouts().world().robots().size(), 2u);
}

TEST_F(LogOpeningTest, NotesTellOfOtherUnitsAndNameNoFlag) {
    const std::string file = makeLog([](Log& log) {
        log.synthetic = false;
        log.robots[0].robot = "robot";
        for (Trajectory& trajectory : log.robots[0].trajectories)
            for (StampedPose& stamped : trajectory.poses) stamped.pose.heading *= 180 / std::numbers::pi;
    });
    PlayedLogRequest request{file, ""};
    request.robotFile = "pioneer1.toml";
    ASSERT_EQ(refusal(request), "");
    settleAll();
    EXPECT_THAT(notes(), Contains(HasSubstr("radians")));
    EXPECT_THAT(notes(), Not(Contains(HasSubstr("robot robot"))));
    EXPECT_THAT(notes(), Contains(HasSubstr("not learned from the robot")));
    for (const std::string& log : {shipped(), (sourceFolder() / "resources/logs/pioneer").string()}) {
        ASSERT_NO_FATAL_FAILURE(openLog(log));
        EXPECT_THAT(notes(), Not(Contains(HasSubstr("--"))));
    }
}

TEST_F(LogOpeningTest, WhoThinksBetterOfItKeepsWhatIsOpen) {
    ASSERT_NO_FATAL_FAILURE(work());
    const State before = now();
    dropAndSettle(ownLog());
    ASSERT_NE(dialog(), nullptr);
    QTest::keyClick(dialog(), Qt::Key_Escape);
    settleAll();
    EXPECT_EQ(now(), before);
    EXPECT_THAT(errors(), IsEmpty());
    EXPECT_TRUE(dialog() == nullptr || !dialog()->isVisible());
}

TEST_F(LogOpeningTest, RobotFileOfOnesOwnComesIntoTheList) {
    dropAndSettle(ownLog());
    ASSERT_NE(dialog(), nullptr);
    const int shippedOnes = dialog()->robots().count();
    dialog()->choose(qtText(write("bad.toml", "format = \"mrose robot\"\nversion = 1\n")));
    EXPECT_THAT(dialog()->error().toStdString(), HasSubstr("bad.toml"));
    dialog()->choose(qtText(writeGame()));
    EXPECT_THAT(dialog()->error().toStdString(), HasSubstr("expected format = \"mrose robot\""));
    EXPECT_EQ(dialog()->robots().count(), shippedOnes);
    const std::string mine = write("mine.toml", robot(9));
    dialog()->choose(qtText(mine));
    EXPECT_TRUE(dialog()->error().isEmpty());
    ASSERT_EQ(dialog()->robots().count(), shippedOnes + 1);
    EXPECT_EQ(dialog()->robots().currentRow(), shippedOnes);
    QTest::keyClick(&dialog()->robots(), Qt::Key_Return);
    settleAll();
    ASSERT_TRUE(overlay.rollouts().log());
    EXPECT_EQ(overlay.rollouts().world().parts().scene.typeOf(0).mass, 9);
}

TEST_F(LogOpeningTest, ScriptsSayWhatDrove) {
    const std::string file = ownLog();
    const auto run = [&](const std::string& script) {
        const auto done =
            runScript(window.scripted(), script, "s.lua",
                      {[](const std::string&) {}, [](const std::string& mistake) { ADD_FAILURE() << mistake; }});
        return done ? "" : done.error().message();
    };
    EXPECT_THAT(run("open_log('" + file + "')"), HasSubstr("does not say what kind of robot drove"));
    EXPECT_EQ(dialog(), nullptr);
    EXPECT_EQ(run("open_log('" + file + "', 'pioneer1.toml')\nexpect(reality('rollouts') > 0)"), "");
    EXPECT_THAT(run("open_log('" + file + "', 'missing.toml')"), HasSubstr("missing.toml"));
    EXPECT_THAT(run("open_log('" + file + "', 3)"), HasSubstr("expected a text as argument 2"));
}

TEST_F(LogOpeningTest, WhatCannotBeOpenedLeavesAllAsItIs) {
    ASSERT_NO_FATAL_FAILURE(work());
    const State before = now();
    const std::string own = ownLog(), text = readFile(own).value_or("");
    const std::string noTruth = path("blind.csv");
    {
        auto log = readLog(own);
        ASSERT_TRUE(log);
        for (Trajectory& trajectory : log->robots[0].trajectories) trajectory.poses.clear();
        ASSERT_TRUE(writeCsv(noTruth, *log));
    }
    PlayedLogRequest badRobot{own, ""}, noScenario{shipped(), path("missing.toml")}, otherRobots{shipped(), ""};
    badRobot.robotFile = write("bad.toml", "format = \"mrose robot\"\nversion = 1\nmass_kg = -1\n");
    otherRobots.robots = {"nobody"};
    PlayedLogRequest noRobot{own, ""};
    noRobot.robotFile = "nosuch.toml";
    PlayedLogRequest blind{noTruth, ""};
    blind.robotFile = "pioneer1.toml";
    const std::vector<std::pair<PlayedLogRequest, std::string>> wrong{
        {{path("missing.csv"), ""}, "does not exist"},
        {{write("foreign.csv", "a,b\n1,2\n"), ""}, "is no log"},
        {{write("half.csv", text.substr(0, text.rfind(',')) + "\n"), ""}, "half.csv:"},
        {blind, "has no ground truth"},
        {badRobot, "bad.toml"},
        {noRobot, "--robot nosuch.toml: does not exist"},
        {noScenario, "missing.toml"},
        {otherRobots, "nobody"}};
    for (const auto& [request, words] : wrong) {
        window.messages().clear();
        overlay.open(request);
        settleAll();
        ASSERT_THAT(errors(), testing::SizeIs(1)) << words;
        EXPECT_THAT(errors()[0], HasSubstr(words));
        EXPECT_THAT(errors()[0], Not(HasSubstr("\n")));
        EXPECT_EQ(now(), before) << words;
    }
    window.messages().clear();
    overlay.open({shipped(), ""}, RolloutPlan{RolloutPlan::Cut::every, 1e5, 10});
    settleAll();
    EXPECT_THAT(errors(), ElementsAre(HasSubstr("expected an earlier start")));
    EXPECT_EQ(now(), before);
    // And all of it still works.
    window.files().saver().setQuestion([](const QString&) { return RunSaver::Answer::discard; });
    overlay.shown().showNext(1);
    settleAll();
    EXPECT_EQ(overlay.rollouts().shown(), 3u);
}

TEST_F(LogOpeningTest, UnsavedBranchesAreAskedAboutOnceTheOtherLogIsThere) {
    ASSERT_NO_FATAL_FAILURE(work());
    const State before = now();
    int asked = 0;
    auto answer = RunSaver::Answer::cancel;
    window.files().saver().setQuestion([&](const QString&) { return ++asked, answer; });
    overlay.open({path("missing.csv"), ""});
    settleAll();
    EXPECT_EQ(asked, 0);
    const std::string other = makeLog();
    overlay.open({other, ""});
    settleAll();
    EXPECT_EQ(asked, 1);
    EXPECT_EQ(now(), before);
    answer = RunSaver::Answer::discard;
    overlay.open({other, ""});
    settleAll();
    EXPECT_EQ(asked, 2);
    EXPECT_EQ(overlay.rollouts().log()->place, other);
    EXPECT_THAT(overlay.models().all(), testing::SizeIs(1));
}

TEST_F(LogOpeningTest, FolderOfLogsIsExplained) {
    for (const char* name : {"one", "two"}) write(std::string(name) + "/Robot1_Odometry.dat", "1 0.1 0 \n2 0.1 0 \n");
    dropAndSettle(folder.path().string());
    EXPECT_THAT(errors(), ElementsAre(HasSubstr("is not a log itself; it holds one and two: open one of them")));
    window.messages().clear();
    window.actions().perform("open_log", qtText(folder.path().string()));
    settleAll();
    EXPECT_THAT(errors(), ElementsAre(HasSubstr("is not a log itself; it holds one and two: open one of them")));
}

TEST_F(LogOpeningTest, ColumnsHoldAllThatTheyShow) {
    // Rollouts from 0 to 1190 s: the widest starts come last.
    const std::string file = makeLog([](Log& log) {
        Trajectory& trajectory = log.robots[0].trajectories[0];
        log.robots[0].trajectories.resize(1);
        trajectory.commands.clear();
        trajectory.poses.clear();
        Pose pose{0, 0, 0};
        const Command command{0.4, 0.4};
        for (Nanoseconds time = 0; time <= 1'201 * nanosecondsPerSecond; time += nanosecondsPerSecond / 20) {
            trajectory.commands.push_back({time, command});
            trajectory.poses.push_back({time, pose});
            pose = pose * exp({command.v / 20, 0, command.w / 20});
        }
    });
    dropAndSettle(file);
    ASSERT_GT(overlay.rollouts().rows().size(), 110u);
    const QTreeView& list = panel.list();
    const QFontMetrics metrics = list.fontMetrics();
    constexpr int margins = 6;  // of a cell, pixels
    for (int column = 0; column < RolloutList::columns; ++column)
        for (int line = 0; line < list.model()->rowCount() && !list.isColumnHidden(column); ++line)
            ASSERT_LE(RolloutList::isName(column)
                          ? 0
                          : metrics.horizontalAdvance(list.model()->index(line, column).data().toString()) + margins,
                      list.columnWidth(column))
                << "column " << column << ", line " << line;
    EXPECT_LE(list.header()->length(), list.viewport()->width());
    EXPECT_FALSE(list.horizontalScrollBar()->isVisible());
}

/// The real one, where it is.
TEST_F(LogOpeningTest, WindowsOfARealHuskyHaveTheFiguresOfEvaluate) {
    const std::string file = placeOfLog("husky_windows.csv");
    if (!looksLikeLog(file)) GTEST_SKIP() << "no Husky windows: set MROSE_DATA";
    dropAndSettle(file);
    EXPECT_THAT(errors(), IsEmpty());
    ASSERT_NE(overlay.rollouts().comparison(), nullptr);
    auto network = loadNetwork(sourceFolder() / "nets" / "husky.net");
    ASSERT_TRUE(network);
    LogOptions options;
    if (network->drive) options.drive = *network->drive;
    const auto log = readLog(file, options);
    ASSERT_TRUE(log);
    const LearnedModel model(std::make_shared<const LearnedMotion>(std::move(*network)), "husky");
    const NamedModel named = NamedModel::same("network", model);
    const auto evaluation = evaluate(*log, {&named, 1});
    ASSERT_TRUE(evaluation);
    EXPECT_EQ(overlay.rollouts().requests().size(), evaluation->log.windows.size());
    EXPECT_EQ(overlay.rollouts().comparison()->all.counted.p, evaluation->models[0].all.p);
    EXPECT_EQ(overlay.rollouts().comparison()->all.counted.hd, evaluation->models[0].all.hd);
}

}  // namespace
}  // namespace mrose::gui
