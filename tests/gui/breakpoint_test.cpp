// Breakpoints in the window: by keys and mouse, in its list, on its timeline and from its command line's words.
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QSettings>
#include <QTemporaryDir>
#include <future>

#include "condition/condition.h"
#include "files/window_files.h"
#include "frame/window_memory.h"
#include "gui/window_fixture.h"
#include "panels/breakpoint_panel.h"
#include "scripting/window_script.h"
#include "widgets/timeline_bar.h"

namespace mrose::gui {
namespace {

class BreakpointTest : public WindowTest {
protected:
    QListWidget& list() const { return *window.findChild<QListWidget*>("breakpoint_list"); }
    QLineEdit& line() const { return *window.findChild<QLineEdit*>("breakpoint_line"); }
    QString told() const { return window.findChild<QLabel*>("breakpoint_reply")->text(); }
    const BreakpointState& state(std::size_t i) const { return window.shown()->breakpoints[i]; }
    std::int64_t tick() const { return window.shown()->tick(); }
    std::string message() const { return window.shown()->message; }

    void seek(std::int64_t tick) {
        window.session().seek(tick, false);
        settle();
    }
    /// Types it, as a user does.
    void add(const char* text) {
        key(Qt::Key_F8);
        ASSERT_EQ(QApplication::focusWidget(), &line());
        line().clear();
        QTest::keyClicks(&line(), text);
        QTest::keyClick(&line(), Qt::Key_Return);
        settle();
    }
    /// Without breakHere(), which is there at first.
    void only(const char* text) {
        window.session().setBreakpoints({});
        settle();
        add(text);
    }
    /// Plays as fast as possible to where it stops.
    void play() {
        window.session().setSpeed(0);
        key(Qt::Key_Space);
        ASSERT_TRUE(QTest::qWaitFor([&] { return !window.shown()->playing; }, 60'000));
        settle();
    }
    void clickBox(int row) {
        list().scrollToItem(list().item(row));
        const QRect place = list().visualItemRect(list().item(row));
        QTest::mouseClick(list().viewport(), Qt::LeftButton, Qt::NoModifier, QPoint(12, place.center().y()));
        settle();
    }
    /// At every tick of the run from its start, without the window.
    std::vector<bool> walked(const std::string& text, std::int64_t ticks) const {
        const Scenario& scenario = *window.shown()->setup->scenario;
        auto condition = compileCondition(text, scenario);
        WorldState world = scenario.initialState();
        StepBuffers buffers;
        StepTrace trace;
        std::vector<bool> held{*condition->holds({&scenario, &world})};
        while (world.tick < ticks) {
            step(scenario, world, buffers, {}, &trace);
            held.push_back(*condition->holds({&scenario, &world, &trace}));
        }
        return held;
    }
    static std::vector<std::int64_t> beginningsOf(const std::vector<bool>& held) {
        std::vector<std::int64_t> ticks;
        for (std::size_t i = 1; i < held.size(); ++i)
            if (held[i] && !held[i - 1]) ticks.push_back(static_cast<std::int64_t>(i));
        return ticks;
    }
};

constexpr const char* fast = "robot[2].speed > 0.42";

TEST_F(BreakpointTest, LineStaysWhereItIsWhenAnErrorIsTold) {
    key(Qt::Key_F8);
    settle();
    const QPoint at = line().mapTo(&window, QPoint(0, 0));
    QTest::keyClicks(&line(), "robot[9].speed > 0.1 and robot[2].speed > 0.5");
    QTest::keyClick(&line(), Qt::Key_Return);
    settle();
    QApplication::processEvents();
    ASSERT_NE(told(), "");
    EXPECT_EQ(line().mapTo(&window, QPoint(0, 0)), at);
    line().clear();
    QApplication::processEvents();
    EXPECT_EQ(line().mapTo(&window, QPoint(0, 0)), at);
}

TEST_F(BreakpointTest, TypedConditionStopsPlayingAndRunningAtItsBeginnings) {
    const std::vector<std::int64_t> ticks = beginningsOf(walked(fast, 1500));
    ASSERT_GE(ticks.size(), 3u);
    only(fast);
    ASSERT_EQ(list().count(), 1);
    EXPECT_EQ(list().item(0)->text(), fast);
    play();
    EXPECT_EQ(tick(), ticks[0]);
    char expected[80];
    std::snprintf(expected, sizeof expected, "Stopped at %.2f s: %s", static_cast<double>(ticks[0]) * 0.02, fast);
    EXPECT_EQ(message(), expected);
    EXPECT_TRUE(window.shown()->atBreak);
    key(Qt::Key_F6);
    EXPECT_EQ(tick(), ticks[1]);
    play();
    EXPECT_EQ(tick(), ticks[2]);
    EXPECT_EQ(state(0).hits, 3);
    // The same where it has been.
    seek(0);
    EXPECT_EQ(message(), "");
    key(Qt::Key_F6);
    EXPECT_EQ(tick(), ticks[0]);
    play();
    EXPECT_EQ(tick(), ticks[1]);
}

TEST_F(BreakpointTest, BackGoesToTheBeginningOfEachStretch) {
    const std::vector<bool> held = walked(fast, 1500);
    only(fast);
    seek(1500);
    for (int i = 0; i < 4; ++i) {
        std::int64_t expected = tick() - 1;
        const auto begins = [&](std::int64_t at) {
            return held[static_cast<std::size_t>(at)] && !held[static_cast<std::size_t>(at - 1)];
        };
        while (expected > 0 && !begins(expected)) --expected;
        if (expected == 0) break;
        key(Qt::Key_F6, Qt::ShiftModifier);
        EXPECT_EQ(tick(), expected);
        EXPECT_EQ(message().substr(0, 8), "Back at ");
    }
    seek(1);
    key(Qt::Key_F6, Qt::ShiftModifier);
    EXPECT_EQ(tick(), 1);
    EXPECT_EQ(message(), "No breakpoint was met before this tick");
}

TEST_F(BreakpointTest, BackCrossesTheDepartureOfABranch) {
    const std::vector<bool> held = walked(fast, 600);
    seek(600);
    drag(pixelOf(8), pixelOf(8) + QPointF(25, 25));
    ASSERT_EQ(window.shown()->branch, 1u);
    seek(603);
    only(fast);
    std::int64_t last = 599;
    while (!held[static_cast<std::size_t>(last)] || held[static_cast<std::size_t>(last - 1)]) --last;
    // The branch's own ticks first, if it begins to hold there.
    for (int i = 0; i < 3 && tick() >= 600; ++i) key(Qt::Key_F6, Qt::ShiftModifier);
    EXPECT_EQ(window.shown()->branch, 1u);
    EXPECT_EQ(tick(), last);
}

TEST_F(BreakpointTest, ChosenOneAndAnyConditionAreAskedWhenTheyLastHeld) {
    const std::vector<bool> held = walked(fast, 800);
    std::int64_t last = 799;
    while (!held[static_cast<std::size_t>(last)]) --last;
    if (last == 799)
        while (held[static_cast<std::size_t>(last - 1)]) --last;
    seek(800);
    add(fast);
    // Others do not matter, nor whether it is on.
    add("time > 15.5");
    list().setCurrentRow(1);
    key(Qt::Key_F9);
    ASSERT_FALSE(state(1).breakpoint.enabled);
    key(Qt::Key_F7);
    EXPECT_EQ(tick(), last);
    seek(800);
    ASSERT_TRUE(window.actions().perform("break_last", QString("tick == 123")));
    settle();
    EXPECT_EQ(tick(), 123);
    EXPECT_EQ(message(), "Back at 2.46 s: tick == 123");
    ASSERT_TRUE(window.actions().perform("break_last", QString("tick == 123")));
    settle();
    EXPECT_EQ(message(), "Before this tick it never held: tick == 123");
    EXPECT_FALSE(window.actions().perform("break_last", QString("tik == 123")));
}

TEST_F(BreakpointTest, MistakeIsToldWhileItIsTypedAndNotAdded) {
    const int before = list().count();
    key(Qt::Key_F8);
    for (const auto& [text, wrong] :
         {std::pair{"robot[2].sped > 1", "there is no 'sped'"}, std::pair{"robot[2].speed >", "unexpected symbol"},
          std::pair{"robot[9].x > 1", "there is no robot 9"}, std::pair{"contact rod 2", "did you mean red 2?"},
          std::pair{"(function() while true do end end)()", "does not end within 10000 instructions"},
          std::pair{"(function() local t = {} while true do t[#t+1] = 1 end end)()", ""},
          std::pair{"robot[2].error > 0.1", "'error' needs a real log beside the run: none is open (at character 10)"},
          std::pair{"1 + 1", "expected true or false"}}) {
        line().clear();
        QTest::keyClicks(&line(), text);
        EXPECT_TRUE(told().contains(wrong)) << told().toStdString();
        EXPECT_FALSE(told().contains('\n'));
        QTest::keyClick(&line(), Qt::Key_Return);
        settle();
        EXPECT_EQ(list().count(), before) << text;
        EXPECT_EQ(line().text(), text);
    }
    line().clear();
    EXPECT_EQ(told(), "");
    QTest::keyClicks(&line(), "ball.speed > 1");
    EXPECT_EQ(told(), "Enter adds it");
}

TEST_F(BreakpointTest, OneThatFailsWhileItRunsStopsOnceAndIsOff) {
    only("(function() if tick == 30 then while true do end end return tick == 60 end)()");
    play();
    EXPECT_EQ(tick(), 30);
    EXPECT_TRUE(message().find("does not end within 10000 instructions") != std::string::npos) << message();
    EXPECT_FALSE(state(0).breakpoint.enabled);
    EXPECT_EQ(list().item(0)->checkState(), Qt::Unchecked);
    EXPECT_EQ(told(), "switched off: does not end within 10000 instructions");
    // Once switched on again it is asked on.
    clickBox(0);
    ASSERT_TRUE(state(0).breakpoint.enabled);
    EXPECT_EQ(state(0).breakpoint.error, "");
    play();
    EXPECT_EQ(tick(), 60);
}

TEST_F(BreakpointTest, EnabledOnceAndCountedByKeysAndMouse) {
    const std::vector<std::int64_t> ticks = beginningsOf(walked(fast, 9000));
    ASSERT_GT(ticks.size(), 4u);
    only(fast);
    clickBox(0);
    EXPECT_FALSE(state(0).breakpoint.enabled);
    key(Qt::Key_F9);
    EXPECT_TRUE(state(0).breakpoint.enabled);
    key(Qt::Key_F9, Qt::ControlModifier);
    EXPECT_TRUE(state(0).breakpoint.oneShot);
    play();
    EXPECT_EQ(tick(), ticks[0]);
    EXPECT_FALSE(state(0).breakpoint.enabled);
    key(Qt::Key_F9, Qt::ControlModifier);
    key(Qt::Key_F9, Qt::ShiftModifier);
    EXPECT_TRUE(state(0).breakpoint.enabled);
    ASSERT_TRUE(window.actions().perform("break_from", QString("4")));
    settle();
    play();
    EXPECT_EQ(tick(), ticks[3]);
    EXPECT_FALSE(window.actions().perform("break_from", QString("0")));
    key(Qt::Key_F9, Qt::ShiftModifier);
    EXPECT_FALSE(state(0).breakpoint.enabled);
    seek(ticks[4] + 5);
    EXPECT_EQ(tick(), ticks[4] + 5);
    QTest::keyClick(&list(), Qt::Key_Delete);
    settle();
    EXPECT_EQ(list().count(), 0);
    add("contact");
    key(Qt::Key_F8, Qt::ShiftModifier);
    EXPECT_EQ(list().count(), 0);
}

TEST_F(BreakpointTest, TextIsEditedInItsRow) {
    only("tick == 40");
    list().editItem(list().item(0));
    auto* editor = list().findChild<QLineEdit*>();
    ASSERT_NE(editor, nullptr);
    editor->setText("tick == 45");
    QTest::keyClick(editor, Qt::Key_Return);
    settle();  // the row takes it
    settle();  // and the session
    EXPECT_EQ(state(0).breakpoint.text, "tick == 45");
    key(Qt::Key_F6);
    EXPECT_EQ(tick(), 45);
}

TEST_F(BreakpointTest, ContactAndKickOfTheSelectedBody) {
    seek(6000);
    std::int64_t contact = -1, kick = -1;
    std::uint32_t kicker = 0;  // whoever is the first to
    for (const TimelineMark& mark : *window.shown()->marks)
        if (kick < 0 && mark.kind == TimelineMark::Kind::kick) {
            kick = mark.tick;
            kicker = mark.body;
        }
    for (const TimelineMark& mark : *window.shown()->marks) {
        const bool its = mark.body == kicker || mark.other == kicker;
        if (contact < 0 && mark.kind == TimelineMark::Kind::contact && its) contact = mark.tick;
    }
    ASSERT_GT(contact, 0);
    ASSERT_GT(kick, 0);
    const std::string name = window.shown()->setup->scenario->scene().robots[kicker].name;
    seek(0);
    window.session().setBreakpoints({});
    settle();
    window.field().setSelected(static_cast<int>(kicker));
    key(Qt::Key_C, Qt::ShiftModifier);
    ASSERT_EQ(state(0).breakpoint.text, "contact " + name);
    key(Qt::Key_F6);
    EXPECT_EQ(tick(), contact);
    EXPECT_NE(message().find(name), std::string::npos);
    window.session().setBreakpoints({});
    settle();
    seek(0);
    key(Qt::Key_K, Qt::ShiftModifier);
    ASSERT_EQ(state(0).breakpoint.text, "kick " + name);
    play();
    EXPECT_EQ(tick(), kick);
    EXPECT_NE(message().find(name + " kicks ball"), std::string::npos) << message();
    seek(kick + 100);
    while (tick() > kick) {
        const std::int64_t before = tick();
        key(Qt::Key_F6, Qt::ShiftModifier);
        ASSERT_LT(tick(), before);
    }
    EXPECT_EQ(tick(), kick);
}

TEST_F(BreakpointTest, SeekingArrivesWhereItWasToldToAndOnlyPlayingStops) {
    only("tick == 50 or tick == 150");
    TimelineBar& timeline = window.timeline();
    QTest::mouseClick(&timeline, Qt::LeftButton, Qt::NoModifier, QPoint(static_cast<int>(timeline.pixelOf(100)), 40));
    settle();
    EXPECT_NEAR(static_cast<double>(tick()), 100, 5);
    window.session().seek(200);
    settle();
    EXPECT_EQ(tick(), 200);
    std::string wrong;
    const ScriptOutput output{[](const std::string&) {}, [&](const std::string& text) { wrong += text; }};
    const auto outcome = runScript(window.scripted(), "seek(0) seek(4)", "test", output);
    ASSERT_TRUE(outcome) << outcome.error().message();
    EXPECT_EQ(tick(), 200);
    window.session().seek(0);
    window.session().setSpeed(0);
    window.session().play();
    ASSERT_TRUE(QTest::qWaitFor([&] { return tick() == 50 && !window.shown()->playing; }, 60'000));
}

TEST_F(BreakpointTest, HitsAreMarkedOnTheTimeline) {
    seek(1000);
    const std::vector<std::int64_t> expected = beginningsOf(walked(fast, 1000));
    add(fast);
    const auto hits = [&] {
        std::vector<std::int64_t> ticks;
        for (const TimelineMark& mark : *window.shown()->marks)
            if (mark.kind == TimelineMark::Kind::hit) ticks.push_back(mark.tick);
        return ticks;
    };
    EXPECT_TRUE(QTest::qWaitFor([&] { return hits() == expected; }, 60'000));
    EXPECT_TRUE(QTest::qWaitFor([&] { return state(1).known; }, 60'000));
    EXPECT_EQ(state(1).all, static_cast<std::int64_t>(expected.size()));
    const double pixel = window.timeline().pixelOf(expected[1]);
    EXPECT_TRUE(window.timeline().textAt(pixel).contains("breakpoint"))
        << window.timeline().textAt(pixel).toStdString();
    EXPECT_TRUE(window.timeline().textAt(pixel).contains(QString(fast).toHtmlEscaped()));
    key(Qt::Key_F9);
    EXPECT_TRUE(hits().empty());
}

TEST_F(BreakpointTest, LongSearchIsEndedWhenTheUserSaysSo) {
    seek(3000);
    only("(function() for i = 1, 1500 do local x = robot[1].x end return false end)()");
    seek(3000);
    QString told;
    QObject::connect(&window.session(), &Session::working, &window, [&](const QString& what, double) { told = what; });
    // The search waits for what is under way, so that the key comes before its end.
    std::promise<void> underWay;
    window.session().doLongWork("", [&](TimeTravel&, const Progress&) { underWay.get_future().wait(); });
    QTest::keyClick(&window, Qt::Key_F6, Qt::ShiftModifier);
    QTest::keyClick(&window, Qt::Key_Escape);
    underWay.set_value();
    settle();
    EXPECT_EQ(told, "Looking for the last break");
    EXPECT_EQ(message(), "Ended before a break was found");
    EXPECT_EQ(tick(), 3000);
}

TEST_F(BreakpointTest, RunningWithoutABreakEndsWherePlayingEnds) {
    only("time < 0");
    key(Qt::Key_F6);
    EXPECT_EQ(tick(), 3000);
    EXPECT_EQ(message(), "No break up to 60 s; it can go on");
    key(Qt::Key_F6);
    EXPECT_EQ(tick(), 6000);
}

TEST_F(BreakpointTest, DivergenceIsOfferedOnceThereIsALog) {
    const QAction& action = window.actions()["break_on_divergence"];
    EXPECT_FALSE(action.isEnabled());
    EXPECT_TRUE(action.toolTip().contains("Lay a log over"));
    EXPECT_FALSE(window.actions().perform("break_on_divergence", {}));
    window.session().setBreakpoints({});
    window.session().changeBreakpoints([](Breakpoints& all) {
        all.setDivergence({[](const BranchTree&, std::uint32_t, std::int64_t tick) { return tick >= 77; },
                           [](const BranchTree&, std::uint32_t, std::int64_t) { return "it leaves"; }});
    });
    settle();
    ASSERT_TRUE(action.isEnabled());
    key(Qt::Key_D, Qt::ShiftModifier);
    play();
    EXPECT_EQ(tick(), 77);
    EXPECT_NE(message().find("it leaves"), std::string::npos);
    seek(300);
    key(Qt::Key_F6, Qt::ShiftModifier);
    EXPECT_EQ(tick(), 77);
    window.session().changeBreakpoints([](Breakpoints& all) { all.setDivergence({}); });
    settle();
    EXPECT_FALSE(action.isEnabled());
    EXPECT_EQ(state(0).unfit, "no log is laid over the run yet");
}

TEST_F(BreakpointTest, AreKeptByScenario) {
    const QTemporaryDir folder;
    const auto settings = [&] {
        return std::make_unique<QSettings>(folder.filePath("kept.ini"), QSettings::IniFormat);
    };
    window.frame().memory.restore(settings());
    ASSERT_TRUE(window.open("soccer.toml"));
    settle();
    only(fast);
    key(Qt::Key_F9, Qt::ControlModifier);
    ASSERT_TRUE(window.actions().perform("break_from", QString("2")));
    settle();
    add("contact red 2");
    key(Qt::Key_F9);
    window.frame().memory.save();
    MainWindow other;
    other.frame().memory.restore(settings());
    ASSERT_TRUE(other.open("b21_corridor.toml"));
    other.session().settle();
    EXPECT_EQ(other.shown()->breakpoints.size(), 1u);
    ASSERT_TRUE(other.open("soccer.toml"));
    other.session().settle();
    ASSERT_EQ(other.shown()->breakpoints.size(), 2u);
    const Breakpoint &first = other.shown()->breakpoints[0].breakpoint,
                     &second = other.shown()->breakpoints[1].breakpoint;
    EXPECT_EQ(first.text, fast);
    EXPECT_TRUE(first.enabled && first.oneShot && first.from == 2);
    EXPECT_EQ(second.text, "contact red 2");
    EXPECT_FALSE(second.enabled);
}

TEST_F(BreakpointTest, ScriptsSetAndReachThem) {
    const std::vector<std::int64_t> ticks = beginningsOf(walked(fast, 1500));
    std::string words;
    const std::string text = "add_break('" + std::string(fast) +
                             "')\nbreak_forward(2)\nsay(tick)\nbreak_back()\nsay(tick)\n" +
                             "seek(20)\nbreak_last('time < 1')\nsay(tick, message)\ntoggle_break(2)";
    const auto outcome =
        runScript(window.scripted(), text, "s.lua", {[&](const std::string& said) { words += said + '\n'; }, {}});
    ASSERT_TRUE(outcome) << outcome.error().message();
    EXPECT_EQ(words.substr(0, words.find('\n')), std::to_string(ticks[1]));
    EXPECT_NE(words.find("\n49 Back at 0.98 s: time < 1\n"), std::string::npos) << words;
    const auto wrong = runScript(window.scripted(), "add_break('tik > 1')", "s.lua", {[](const std::string&) {}, {}});
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().message(), "s.lua:1: add_break(): unknown name 'tik'; did you mean tick? (at character 1)");
}

}  // namespace
}  // namespace mrose::gui
