// The program mrose-gui as a process, without a display.
#include <QImage>
#include <QTest>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "recording/recording.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class GuiProgram : public testing::Test {
protected:
    static ProgramResult run(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(),
                         (std::filesystem::path(mroseProgram()).parent_path() / "mrose-gui").string());
        return RunningProgram(arguments).finish();
    }
    static ProgramResult offscreen(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "--offscreen");
        return run(arguments);
    }
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(path(name)) << text;
        return path(name);
    }
    /// One line that begins with the program's name.
    static void expectOneLine(const ProgramResult& result, const std::vector<std::string>& parts, int status) {
        EXPECT_EQ(result.status, status) << result.err;
        EXPECT_THAT(result.err, StartsWith("mrose-gui: "));
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        for (const std::string& part : parts) EXPECT_THAT(result.err, HasSubstr(part));
    }

    TemporaryFolder folder_;
};

TEST_F(GuiProgram, TellsVersionHelpAndKeys) {
    EXPECT_THAT(run({"--version"}).out, StartsWith("mrose-gui 0."));
    const ProgramResult help = run({"--help"});
    EXPECT_EQ(help.status, 0);
    for (const char* flag :
         {"--run", "--ticks", "--duration", "--seed", "--speed", "--select", "--layers", "--size", "--dark", "--at",
          "--script", "--screenshot", "--record", "--headless", "Examples:\n  mrose-gui"})
        EXPECT_THAT(help.out, HasSubstr(flag));
    const ProgramResult keys = run({"--keys"});
    EXPECT_EQ(keys.status, 0);
    EXPECT_EQ(keys.err, "");
    EXPECT_THAT(keys.out, HasSubstr("\n  Space "));
}

TEST_F(GuiProgram, LogIsCutIntoTheRolloutsOfCompare) {
    const std::string log = (sourceFolder() / "resources" / "logs" / "pioneer" / "random.csv").string();
    const std::string script = write("courses.lua", "say(reality('rollouts'))\n");
    const ProgramResult cut = offscreen({log, "--every", "2", "--duration", "10", "--script", script});
    EXPECT_EQ(cut.status, 0) << cut.err;
    EXPECT_THAT(cut.out, StartsWith("20")) << "five of each of its four trajectories";
}

TEST_F(GuiProgram, ModelThatIsNotThereFails) {
    const std::string log = (sourceFolder() / "resources" / "logs" / "pioneer" / "random.csv").string();
    expectOneLine(offscreen({log, "--model", path("nosuch.net"), "--screenshot", path("a.png")}),
                  {"nosuch.net", "cannot be read"}, 1);
}

TEST_F(GuiProgram, RunHasTheStatesOfMrose) {
    for (const char* seed : {"1", "7"}) {
        const ProgramResult plain = runMrose({"run", "soccer.toml", "--seed", seed, "--duration", "5", "--quiet"});
        const std::string state = plain.out.substr(plain.out.find("state "));
        for (const auto& length : {std::pair{"--duration", "5"}, std::pair{"--ticks", "250"}}) {
            const ProgramResult result =
                offscreen({"--run", "soccer.toml", "--seed", seed, length.first, length.second, "--print-hash"});
            EXPECT_EQ(result.status, 0);
            EXPECT_EQ(result.err, "");
            EXPECT_EQ(result.out, state);
        }
    }
    EXPECT_EQ(offscreen({"--run", "soccer.toml", "--ticks", "100", "--print-hash"}).out,
              offscreen({"--run", "soccer.toml", "--ticks", "100", "--speed", "20", "--print-hash"}).out);
}

TEST_F(GuiProgram, RunEndsAtABreakAndSaysWhen) {
    const std::string condition = "robot[2].speed > 0.5";
    const ProgramResult plain = runMrose({"run", "soccer.toml", "--until", condition, "--quiet"});
    const std::string state = plain.out.substr(plain.out.find("state "));
    for (const char* speed : {"0", "50"}) {
        const ProgramResult result = offscreen(
            {"--run", "soccer.toml", "--break", condition, "--break", "time > 50", "--speed", speed, "--print-hash"});
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_THAT(result.out, StartsWith("Stopped at "));
        EXPECT_THAT(result.out, HasSubstr(" s: " + condition + '\n'));
        EXPECT_EQ(result.out.substr(result.out.find("state ")), state);
    }
    EXPECT_EQ(offscreen({"--run", "soccer.toml", "--ticks", "100", "--break", "time > 50"}).out,
              "no break up to 2.00 s\n");
    expectOneLine(offscreen({"--run", "soccer.toml", "--break", "robot[2].sped > 1"}),
                  {"--break robot[2].sped > 1: there is no 'sped'"}, 1);
    expectOneLine(offscreen({"--run", "soccer.toml", "--break"}), {"--break"}, 2);
}

TEST_F(GuiProgram, LayersAreOneWordSoThatAFileMayFollow) {
    EXPECT_EQ(offscreen({"--layers", "names,trails", "--print-hash", "--ticks", "5", "--run", "soccer.toml"}).status,
              0);
    const ProgramResult before = offscreen({"--screenshot", path("a.png"), "--layers", "names,trails", "soccer.toml"});
    EXPECT_EQ(before.status, 0) << before.err;
}

TEST_F(GuiProgram, ScenarioRunsAsLongAsItSays) {
    const std::string quick = write("quick.toml", [] {
        std::ifstream file(sourceFolder() / "resources/scenarios/soccer.toml");
        std::string text((std::istreambuf_iterator<char>(file)), {});
        const auto at = text.find("duration_s = 60.0");
        return text.replace(at, 17, "duration_s = 1.5");
    }());
    const ProgramResult plain = runMrose({"run", quick, "--quiet"});
    EXPECT_EQ(run({"--headless", quick, "--print-hash"}).out, plain.out.substr(plain.out.find("state ")));
}

TEST_F(GuiProgram, PictureHasTheSizeAndTheThemeAskedFor) {
    const std::string light = path("light.png"), dark = path("dark.png");
    for (const auto& [file, flags] : {std::pair{light, std::vector<std::string>{}},
                                      std::pair{dark, std::vector<std::string>{"--dark", "--layers", "none"}}}) {
        std::vector<std::string> words{"--run",    "soccer.toml", "--ticks", "50",           "--size",
                                       "1000x640", "--select",    "red 2",   "--screenshot", file};
        words.insert(words.end(), flags.begin(), flags.end());
        const ProgramResult result = offscreen(words);
        EXPECT_EQ(result.status, 0);
        EXPECT_EQ(result.out + result.err, "");
        EXPECT_EQ(QImage(file.c_str()).size(), QSize(1000, 640)) << file;
    }
    const auto lightness = [](const std::string& file) {
        return QImage(file.c_str())
            .scaled(1, 1, Qt::IgnoreAspectRatio, Qt::SmoothTransformation)
            .pixelColor(0, 0)
            .lightness();
    };
    EXPECT_GT(lightness(light), lightness(dark) + 60);
}

TEST_F(GuiProgram, ScriptDecidesTheExitStatus) {
    const ProgramResult good =
        offscreen({"--script", write("good.lua", "seek(2)\nexpect(tick == 100)\nsay('seen', tick)"), "soccer.toml"});
    EXPECT_EQ(good.status, 0);
    EXPECT_EQ(good.out, "seen 100\n");
    EXPECT_EQ(good.err, "");
    const std::string bad = write("bad.lua", "expect(tick == 5)\nexpect(tick == 0)");
    const ProgramResult failed = offscreen({"--script", bad});
    EXPECT_EQ(failed.status, 1);
    EXPECT_EQ(failed.err, bad + ":1: expected tick == 5\nmrose-gui: " + bad + ": 1 of 2 expectations failed\n");
    expectOneLine(offscreen({"--script", write("wrong.lua", "\nplai()")}), {"wrong.lua:2: ", "did you mean play?"}, 1);
    expectOneLine(offscreen({"--script", path("none.lua")}), {"none.lua: cannot be read"}, 1);
}

TEST_F(GuiProgram, TimeOfTheRunIsNoTimeOfALog) {
    const std::string log = (sourceFolder() / "resources" / "logs" / "pioneer" / "random.csv").string();
    for (const std::vector<std::string>& named : {std::vector<std::string>{log}, {"--log", log}}) {
        std::vector<std::string> line{"--at", "2"};
        line.insert(line.end(), named.begin(), named.end());
        expectOneLine(offscreen(line), {"--at", "--start"}, 2);
    }
}

TEST_F(GuiProgram, ScriptAndFilmGoTogether) {
    const std::string film = path("game.mp4");
    const ProgramResult made = offscreen({"--script", write("s.lua", "seek(1)"), "--film", film, "soccer.toml"});
    EXPECT_EQ(made.status, std::filesystem::exists(film) ? 0 : 1) << made.err;
    EXPECT_THAT(made.err, testing::AnyOf("", HasSubstr("ffmpeg")));
}

/// What is scrubbed, dragged and undone in between leaves no trace in the run.
TEST_F(GuiProgram, ScriptLeavesTheRunAsMroseHasIt) {
    const std::string tour =
        write("tour.lua",
              "seek(3)\ndrag('red 2', 0, 0)\ntick_forward(40)\nundo()\nredo()\nto_start()\nundo()\n"
              "seek(5)\ntick_back(100)\nseek(4)");
    const ProgramResult plain = runMrose({"run", "soccer.toml", "--seed", "3", "--duration", "4", "--quiet"});
    const ProgramResult result = offscreen({"--seed", "3", "--script", tour, "--print-hash", "soccer.toml"});
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.out, plain.out.substr(plain.out.find("state ")));
}

TEST_F(GuiProgram, SaysHowSmallTheWindowMayBe) {
    const std::vector<std::string> run{"--run", "soccer.toml", "--ticks", "2", "--size"};
    const auto sized = [&](const char* size) {
        std::vector<std::string> words = run;
        words.push_back(size);
        return offscreen(words);
    };
    const ProgramResult small = sized("300x200");
    EXPECT_EQ(small.status, 0);
    EXPECT_TRUE(small.err.starts_with("mrose-gui: --size 300x200: the window needs ")) << small.err;
    EXPECT_EQ(sized("1024x620").err, "");
}

TEST_F(GuiProgram, LogThatIsNotThereIsSaidWithWhereItWasLookedFor) {
    const ProgramResult unset = offscreen({"--log", "nolog"});
    EXPECT_EQ(unset.status, 1);
    EXPECT_NE(unset.err.find("nolog: does not exist"), std::string::npos) << unset.err;
    EXPECT_NE(unset.err.find("MROSE_DATA"), std::string::npos) << unset.err;
}

TEST_F(GuiProgram, WrongUsageIsOneLineAndStatusTwo) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"--size", "12"}, "--size"},
        {{"--size", "1000x"}, "--size"},
        {{"--size", "100x100"}, "--size"},
        {{"--ticks", "3", "soccer.toml"}, "--run"},
        {{"--run", "soccer.toml", "--ticks", "-1"}, "--ticks"},
        {{"--run", "soccer.toml", "--ticks", "3", "--duration", "3"}, "--duration"},
        {{"--run", "a.toml", "b.toml"}, "--run"},
        {{"--speed", "nan"}, "nan"},
        {{"--speed", "-1"}, "--speed"},
        {{"--duration", "inf"}, "--duration"},
        {{"--seed", "-1"}, "below 0"},
        {{"--seed", "99999999999999999999"}, "above"},
        {{"--layers", "grid,gird"}, "gird is no layer"},
        {{"--screenshot", ""}, "is empty"},
        {{"a.toml", "b.toml"}, "b.toml"},
        {{"--trial", "abc", "soccer.toml"}, "abc is no trial; expected a whole number"},
        {{"--trial", "4294967296", "soccer.toml"}, "above 4294967295"},
        {{"--seed", "1.5", "soccer.toml"}, "1.5 is no seed; expected a whole number"},
        {{"--colour"}, "--colour"}};
    for (const auto& [words, part] : cases) expectOneLine(offscreen(words), {part}, 2);
}

TEST_F(GuiProgram, WhatIsForALogIsRefusedWithoutOne) {
    for (const std::vector<std::string>& flag : {std::vector<std::string>{"--robots", "77"},
                                                 {"--model", "nothere.net"},
                                                 {"--start", "3"},
                                                 {"--every", "3"},
                                                 {"--windows"},
                                                 {"--robot", "pioneer1.toml"}}) {
        std::vector<std::string> line{"--run", "soccer.toml", "--ticks", "5"};
        line.insert(line.end(), flag.begin(), flag.end());
        expectOneLine(offscreen(line), {flag[0] + ": is for a log", "--run"}, 2);
        line.erase(line.begin(), line.begin() + 4);
        line.insert(line.begin(), "soccer.toml");
        expectOneLine(offscreen(line), {flag[0] + ": is for a log", "--log"}, 2);
    }
    expectOneLine(offscreen({"--run", "soccer.toml", "--ticks", "5", "--log", "/nothere"}),
                  {"--log /nothere: is not read: soccer.toml plays no log"}, 1);
}

TEST_F(GuiProgram, UnattendedNothingIsSimulatedBeyondTheEnd) {
    expectOneLine(offscreen({"--run", "soccer.toml", "--at", "999"}), {"soccer.toml: ends at 60.0 s", "999.0 s"}, 1);
    EXPECT_EQ(offscreen({"--run", "soccer.toml", "--at", "5", "--print-hash"}).out,
              offscreen({"--run", "soccer.toml", "--ticks", "250", "--print-hash"}).out);
}

/// Its duration counts from where it branched.
TEST_F(GuiProgram, TrialThatBranchedOpensAtTheEndOfItsRow) {
    const std::string file =
        write("x.toml",
              "format = \"mrose experiment\"\nversion = 1\nname = \"x\"\nscenario = \"soccer.toml\"\ntrials = 1\n"
              "branch = 'time > 1.5'\nbranch_within_s = 3.0\nduration_s = 1.0\n[[variant]]\nname = \"on\"\n");
    const ProgramResult end = offscreen({file, "--trial", "1", "--variant", "on", "--at", "2.52", "--print-hash"});
    EXPECT_EQ(end.status, 0) << end.err;
    expectOneLine(offscreen({file, "--trial", "1", "--variant", "on", "--at", "2.54"}), {"ends at 2.52 s", "2.54 s"},
                  1);
}

/// No window is left in which something could be done about it.
TEST_F(GuiProgram, FullDiskWhileRecordingIsSaidOnce) {
    const std::string program = (std::filesystem::path(mroseProgram()).parent_path() / "mrose-gui").string();
    RunningProgram::Options options;
    options.fullDisk = true;
    options.room = 60'000;
    const ProgramResult result =
        RunningProgram({program, "--offscreen", "--run", "soccer.toml", "--record", path("game.mcap")}, options)
            .finish();
    expectOneLine(result, {"game.mcap: cannot be written", "its recording ends there"}, 1);
    EXPECT_EQ(result.err.find("make room"), std::string::npos);
    EXPECT_EQ(result.err.find("save all of it"), std::string::npos);
}

/// The window stays; who called it from a terminal reads it there, too.
TEST_F(GuiProgram, WhatCannotBeOpenedIsSaidInTheTerminal) {
    const std::string program = (std::filesystem::path(mroseProgram()).parent_path() / "mrose-gui").string();
    for (const std::vector<std::string>& named :
         {std::vector<std::string>{path("nothere.toml")}, {"--log", path("nothere.toml")}}) {
        std::vector<std::string> words{"/usr/bin/env", "QT_QPA_PLATFORM=offscreen",
                                       "XDG_CONFIG_HOME=" + path("settings"), program};
        words.insert(words.end(), named.begin(), named.end());
        RunningProgram window(words);
        EXPECT_TRUE(window.waitForError("nothere.toml: "));
        window.send(SIGTERM);
        EXPECT_EQ(window.finish().status, 128 + SIGTERM) << "it was still there";
    }
}

/// Whether a user attends or not.
TEST_F(GuiProgram, WhatEndsItFindsTheRecordingWhole) {
    const std::string program = (std::filesystem::path(mroseProgram()).parent_path() / "mrose-gui").string();
    const std::vector<std::string> alone{program,   "--offscreen", "--run",      "soccer.toml",
                                         "--speed", "1",           "--duration", "10000"};
    const std::vector<std::string> attended{"/usr/bin/env", "QT_QPA_PLATFORM=offscreen",
                                            "XDG_CONFIG_HOME=" + path("settings"), program, "soccer.toml"};
    for (std::vector<std::string> words : {alone, attended})
        for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
            const std::string file = path("game.mcap");
            std::filesystem::remove(file);
            words.insert(words.end(), {"--record", file});
            RunningProgram window(words);
            words.resize(words.size() - 2);
            const bool plays = words.size() == alone.size();
            ASSERT_TRUE(QTest::qWaitFor(
                [&] {
                    const auto recording = openRecording(file);
                    return recording && (!plays || recording->branches[0].timeline.last() > 20);
                },
                60'000));
            window.send(signal);
            EXPECT_EQ(window.finish().status, 128 + signal);
            const auto recording = openRecording(file);
            ASSERT_TRUE(recording) << recording.error().message();
            EXPECT_THAT(recording->damage, testing::IsEmpty()) << signal << words[0];
        }
}

TEST_F(GuiProgram, WhatIsWrongWithFilesIsOneLineAndStatusOne) {
    expectOneLine(offscreen({"--run", path("none.toml")}), {"none.toml"}, 1);
    expectOneLine(offscreen({"--run", write("half.toml", "format = \"mrose scenario\"\nvers")}), {"half.toml:2"}, 1);
    expectOneLine(offscreen({"--run", "soccer.toml", "--ticks", "1", "--screenshot", path("no/where.png")}),
                  {"where.png: cannot be written"}, 1);
    expectOneLine(offscreen({"--run", "soccer.toml", "--ticks", "1", "--select", "red 9"}),
                  {"--select red 9", "red 1, red 2"}, 1);
    expectOneLine(offscreen({write("results.csv",
                                   "trial,seed,end,time_s,touches,kicks,hits,faults,driven_m,command\n"
                                   "1,1,duration,1,0,0,0,0,0,mrose run soccer.toml --trial 1 --seed 1\n")}),
                  {"results.csv", "scenario, trial and seed"}, 1);
    const std::string there = write("game.mcap", "earlier");
    expectOneLine(offscreen({"--run", "soccer.toml", "--ticks", "1", "--record", there}), {"is there already"}, 1);
}

/// Qt itself would abort.
TEST_F(GuiProgram, WithoutADisplayItSaysSo) {
    const std::string program = (std::filesystem::path(mroseProgram()).parent_path() / "mrose-gui").string();
    const auto started = [&](const std::vector<std::string>& environment) {
        std::vector<std::string> words{"/usr/bin/env", "-u", "QT_QPA_PLATFORM", "-u", "WAYLAND_DISPLAY"};
        words.insert(words.end(), environment.begin(), environment.end());
        words.push_back(program);
        return RunningProgram(words).finish();
    };
    expectOneLine(started({"-u", "DISPLAY"}), {"there is no display", "--offscreen"}, 1);
    expectOneLine(started({"DISPLAY=:4711"}), {"the display :4711 cannot be used", "--offscreen"}, 1);
}

}  // namespace
}  // namespace mrose
