// Scripts that drive the window: what they can do, what they expect, and how they fail.
#include <QFileInfo>
#include <QImage>
#include <QTemporaryDir>

#include "actions/window_actions.h"
#include "gui/window_fixture.h"
#include "io/file.h"
#include "panels/plot_panel.h"
#include "scripting/window_script.h"
#include "simulation/step.h"
#include "support/places.h"
#include "support/run_program.h"
#include "widgets/message_bar.h"

namespace mrose::gui {
namespace {

class ScriptTest : public WindowTest {
protected:
    /// What was said, then what was not as expected, then the error, a line each.
    std::string run(const std::string& text) {
        std::string said, mistaken;
        const auto outcome = runScript(window.scripted(), text, "tour.lua",
                                       {[&](const std::string& words) { said += words + '\n'; },
                                        [&](const std::string& words) { mistaken += words + '\n'; }});
        if (outcome) outcome_ = *outcome;
        return said + mistaken + (outcome ? "" : outcome.error().message());
    }
    std::string path(const char* name) const { return folder_.filePath(name).toStdString(); }

    QTemporaryDir folder_;
    ScriptOutcome outcome_;
};

TEST_F(ScriptTest, ActionsAndConditionsSpeakOfTheSameWorld) {
    const std::shared_ptr<const Scenario> scenario = window.shown()->frame->scenario;
    WorldState expected = scenario->initialState();
    StepBuffers buffers;
    for (int i = 0; i < 205; ++i) step(*scenario, expected, buffers);
    char place[80];
    std::snprintf(place, sizeof place, "%.10g %.10g\n", expected.robots[1].pose.x, expected.objects[0].pose.y);
    EXPECT_EQ(run("seek(4)\nexpect(time == 4 and tick == 200)\ntick_forward(5)\nsay(robot['red 2'].x, ball.y)"), place);
    EXPECT_EQ(outcome_.expected, 1);
    EXPECT_EQ(window.shown()->hash, hashOf(expected));
}

TEST_F(ScriptTest, SeesBranchesSelectionAndWhetherItPlays) {
    EXPECT_EQ(run("expect(branches == 1 and branch == 'the run' and selected == '' and not playing)\n"
                  "seek_tick(100)\nselect('red 3')\nexpect(selected == 'red 3')\n"
                  "drag('red 3', 1.2, -0.8, pi / 2)\nexpect(branches == 2 and branch == 'red 3 moved')\n"
                  "expect(robot[3].x == 1.2 and robot[3].y == -0.8 and abs(robot[3].heading - pi / 2) < 1e-12)\n"
                  "drag('ball', 0, 1)\nexpect(ball.y == 1 and branches == 2)\n"
                  "undo()\nexpect(branch == 'red 3 moved')\n"
                  "play()\nexpect(playing)\npause()\nexpect(not playing)\n"
                  "rename_branch('other')\nexpect(branch == 'other')"),
              "");
    EXPECT_EQ(outcome_.expected, 9);
    EXPECT_EQ(outcome_.failed, 0);
}

TEST_F(ScriptTest, CheckableActionsAreSwitched) {
    EXPECT_EQ(run("layer_grid(true)\nlayer_grid(true)\nlayer_names(false)"), "");
    EXPECT_TRUE(window.field().layers().has(FieldLayer::grid));
    EXPECT_FALSE(window.field().layers().has(FieldLayer::names));
    EXPECT_EQ(run("layer_grid()"), "");
    EXPECT_FALSE(window.field().layers().has(FieldLayer::grid));
    EXPECT_EQ(run("fit(true)"), "tour.lua:1: fit(): cannot be switched on or off");
}

TEST_F(ScriptTest, KeysReachTheWindow) {
    EXPECT_EQ(run("press('Right')\npress('Right')\nexpect(tick == 2)\npress('Left')\nexpect(tick == 1)\n"
                  "press('Space')\nexpect(playing)\npress('Space')\nexpect(not playing)"),
              "");
    EXPECT_EQ(run("press('Nonsense')").substr(0, 30), "tour.lua:1: press(): Nonsense ");
}

/// As `mrose run --until` of the same condition.
TEST_F(ScriptTest, RunsUntilAConditionHoldsFirst) {
    const std::string condition = "robot[2].kicked or distance(robot[2], ball) < 0.45";
    const ProgramResult program = runMrose({"run", "soccer.toml", "--until", condition, "--quiet"});
    ASSERT_EQ(program.status, 0) << program.err;
    ASSERT_NE(program.out.find("ended by the condition"), std::string::npos) << program.out;
    const std::string state = program.out.substr(program.out.find("state ") + 6, 16);
    EXPECT_EQ(run("expect(run_until('" + condition + "', 60))\nexpect(" + condition + ")\nsay(hash())"), state + '\n');
    EXPECT_EQ(run("to_start()\nexpect(not run_until('tick < 0', 0.5))\nexpect(tick == 25)"), "");
    EXPECT_EQ(run("run_until('balls > 1')"),
              "tour.lua:1: run_until(): condition:1:1: unknown name 'balls'; did you mean ball?");
}

/// Whatever was scrubbed, dragged and undone: the run is the one of the program without a window.
TEST_F(ScriptTest, RunEndsInTheStateOfTheProgramWithoutWindow) {
    const ProgramResult program = runMrose({"run", "soccer.toml", "--duration", "12", "--quiet"});
    const std::string state = program.out.substr(program.out.find("state ") + 6, 16);
    EXPECT_EQ(run("seek(3)\ndrag('red 2', 0, 0)\ntick_forward(100)\ndrag('ball', 1, 1)\nseek(8)\nto_start()\n"
                  "undo()\nundo()\nundo()\nseek(7)\ntick_back(30)\nseek(2)\nother_noise()\ntick_forward(7)\nundo()\n"
                  "seek(12)\nexpect(branch == 'the run')\nsay(hash())"),
              state + '\n');
}

TEST_F(ScriptTest, EachFailedExpectationIsTold) {
    EXPECT_EQ(run("expect(tick == 1)\nexpect(tick == 0)\nexpect(ball.speed > 5, 'a shot')\nsay('on', 1.5, true)"),
              "on 1.5 true\ntour.lua:1: expected tick == 1\ntour.lua:3: expected a shot\n");
    EXPECT_EQ(outcome_.expected, 3);
    EXPECT_EQ(outcome_.failed, 2);
}

TEST_F(ScriptTest, MistakesEndItWithTheirLine) {
    const std::pair<const char*, const char*> cases[] = {
        {"seek(1)\ntick_foward(1)", "tour.lua:2: unknown name 'tick_foward'; did you mean tick_forward?"},
        {"seek(1", "tour.lua:1:7: ')' expected near the end"},
        {"seek('x')", "tour.lua:1: seek(): expected a number as argument 1"},
        {"seek(-1)", "tour.lua:1: seek(): is no time of this run"},
        {"expect(1)", "tour.lua:1: expect(): expected true or false as argument 1"},
        {"\n\ndrag('nobody', 1, 1)",
         "tour.lua:3: drag(): expected one of red 1, red 2, red 3, red 4, blue 1, blue 2, blue 3, blue 4, ball, or its "
         "number from 1"},
        {"play()\ndrag(1, 1, 1)",
         "tour.lua:2: drag(): bodies can be dragged while the run stands; pause() comes first"},
        {"pause()\ndrag(1, 0 / 0, 1)", "tour.lua:2: drag(): expected finite numbers"},
        {"tick_forward(-1)", "tour.lua:1: tick_forward(): -1 is no number of times"},
        {"tick_forward('a')", "tour.lua:1: tick_forward(): takes no text"},
        {"open()", "tour.lua:1: open(): expected a text"},
        {"screenshot('/nowhere/a.png')", "tour.lua:1: screenshot(): /nowhere/a.png: cannot be written"},
        {"screenshot('a.png', 'inspector')",
         "tour.lua:1: screenshot(): the panel \"inspector\" is folded, as it has nothing to show"},
        {"screenshot('a.png', 'kitchen')", "tour.lua:1: screenshot(): kitchen is no part of the window"},
        {"local x = robot[99]", "tour.lua:1: there is no robot 99: there are 8 robots"},
        {"os.exit(3)", "tour.lua:1: unknown name 'os'"},
    };
    for (const auto& [text, error] : cases) EXPECT_EQ(run(text).substr(0, std::string(error).size()), error) << text;
    EXPECT_NE(run("open('nosuch.toml')").find("tour.lua:1: open(): nosuch.toml"), std::string::npos);
}

TEST_F(ScriptTest, LoopsWithoutAnEndAreEnded) {
    EXPECT_EQ(run("seek(1)\nwhile true do\nend"), "tour.lua:2: does not end within 1000000 instructions");
    EXPECT_EQ(run("while true do\n  expect(true)\nend"),
              "tour.lua:2: expect(): is one call too many: a script ends after 100000");
}

TEST_F(ScriptTest, NamesFollowTheScenarioThatIsOpened) {
    const std::string said =
        run("local old = robot['blue 4']\nsay(#robot)\nopen('b21_corridor.toml')\nsay(#robot, #person)\n"
            "say(tick)\nsay(old.x)");
    EXPECT_EQ(said.substr(0, 2), "8\n");
    EXPECT_EQ(said.substr(said.rfind("tour.lua")), "tour.lua:6: this body is of another scenario") << said;
    EXPECT_NE(run("say(ball.x)").find("there is no ball: no object rolls"), std::string::npos);
    EXPECT_EQ(run("open('soccer.toml')\nexpect(#robot == 8 and ball.x == 0)"), "");
}

TEST_F(ScriptTest, NumbersOfTheInspectorArePlotted) {
    EXPECT_EQ(run("plot('red 2', 'speed')\nplot('ball', 'speed')\nplot('red 2', 'distance', 'ball')"), "");
    const std::vector<ValueKey> expected{{"speed", "red 2"}, {"speed", "ball"}, {"distance", "red 2", "ball"}};
    EXPECT_EQ(window.plots().keys(), expected);
    EXPECT_TRUE(run("plot('red 2', 'mood')").starts_with("tour.lua:1: plot(): "));
}

TEST_F(ScriptTest, PicturesShowTheWindowOrAPartOfIt) {
    EXPECT_EQ(
        run("select('red 2')\nscreenshot('" + path("a.png") + "')\nscreenshot('" + path("b.png") + "', 'inspector')"),
        "");
    EXPECT_EQ(QImage(path("a.png").c_str()).size(), window.size());
    const QImage part(path("b.png").c_str());
    EXPECT_EQ(part.size(), window.findChild<QWidget*>("inspector")->size());
}

/// No dialogue stands in a script's way, whatever it calls.
TEST_F(ScriptTest, EveryActionCanBeCalled) {
    for (const Actions::Group& group : window.actions().groups())
        for (const QAction* action : group.actions) {
            const std::string name = action->objectName().toStdString();
            if (name == "quit") continue;
            const std::string result = run(name + "()");
            EXPECT_TRUE(result.empty() || result.starts_with("tour.lua:1: " + name + '(')) << result;
        }
}

TEST_F(ScriptTest, EveryFunctionIsNamedInTheReadme) {
    const std::string readme = readFile(sourceFolder() / "app" / "README.md").value_or("");
    for (const std::string& name : scriptFunctions(window.actions()))
        EXPECT_TRUE(readme.find('`' + name + '`') != std::string::npos ||
                    readme.find('`' + name + '(') != std::string::npos)
            << name;
}

TEST_F(ScriptTest, KeyThatWouldOpenADialogueSaysWhatToCallInstead) {
    window.actions().setUnattended(true);
    EXPECT_EQ(run("press('Ctrl+L')"), "");
    ASSERT_EQ(window.messages().messages().size(), 1u);
    const std::string said = window.messages().messages().front().text.toStdString();
    EXPECT_NE(said.find("open_log"), std::string::npos) << said;
    EXPECT_NE(said.find("dialogues cannot be opened"), std::string::npos) << said;
}

TEST_F(ScriptTest, EndsWithTheWindow) { EXPECT_EQ(run("say(1)\nquit()\nsay(2)"), "1\n"); }

TEST_F(ScriptTest, MisspeltPlotsAreToldWhatThereIs) {
    const std::string quantity = run("plot('red 2', 'commanded_v')");
    EXPECT_NE(quantity.find("there is no commanded_v of red 2; of red 2 there are command_v, "), std::string::npos)
        << quantity;
    EXPECT_EQ(quantity.find("slip"), std::string::npos) << "which only objects have";
}

}  // namespace
}  // namespace mrose::gui
