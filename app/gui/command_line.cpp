#include "command_line.h"

#include <QtGlobal>
#include <charconv>
#include <cstdio>

#include <CLI/CLI.hpp>

#include "shared/flag_checks.h"
#include "widgets/field_layers.h"
#include "workflow/version.h"

namespace mrose::gui {
namespace {

constexpr int usage = 2;

constexpr const char* examples =
    "Examples:\n"
    "  mrose-gui\n"
    "  mrose-gui b21_corridor.toml --seed 7 --dark\n"
    "  mrose-gui --at 3.42 game.mcap\n"
    "  mrose-gui --log MRCLAM_Dataset6\n"
    "  mrose-gui mrclam_replay.toml --log MRCLAM_Dataset6 --robots 1,2 --start 120 --every 5\n"
    "  mrose-gui --at 12.5 soccer.toml --trial 17 --seed 4\n"
    "  mrose-gui --offscreen --run soccer.toml --ticks 400 --select 'red 2' --screenshot soccer.png\n"
    "  mrose-gui --offscreen --run soccer.toml --duration 10 --film game.mp4\n"
    "  mrose-gui --offscreen --script tour.lua\n"
    "A scenario is a file or the name of one that ships. Offscreen, no display is needed. The same scenario and seed\n"
    "give the same states as with `mrose run`, to the last bit.\n"
    "Exit status: 0 all went well and what the script expects held; 1 it did not; 2 the command line does not fit.";

std::string versionText() {
    return "mrose-gui " MROSE_VERSION "\n" MROSE_BUILD_TYPE " build, " MROSE_COMPILER "; Qt " + std::string(qVersion());
}

/// "1280x800"
std::optional<std::pair<int, int>> parseSize(const std::string& text) {
    std::pair<int, int> size;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.first);
    if (width.ec != std::errc() || width.ptr == end || *width.ptr != 'x') return {};
    const auto height = std::from_chars(width.ptr + 1, end, size.second);
    const auto fits = [](int pixels) { return pixels >= 200 && pixels <= 10'000; };
    if (height.ec != std::errc() || height.ptr != end || !fits(size.first) || !fits(size.second)) return {};
    return size;
}

CLI::Validator someSize() {
    return CLI::Validator(
        [](const std::string& text) {
            return parseSize(text) ? std::string()
                                   : text + " is no size; expected WIDTHxHEIGHT, 200 to 10000 pixels each";
        },
        "");
}

CLI::Validator someLayer() {
    return CLI::Validator(
        [](const std::string& text) {
            std::string all;
            for (const FieldLayerText& layer : fieldLayerTexts) {
                const std::string name = std::string(layer.action).substr(std::string("layer_").size());
                if (name == text || text == "none") return std::string();
                all += (all.empty() ? "" : ", ") + name;
            }
            return text + " is no layer; expected some of " + all + ", or none";
        },
        "");
}

void addFlags(CLI::App& app, CommandLine& line, std::string& run, std::string& size) {
    CLI::Option* file = app.add_option("FILE", line.file, "Scenario or recording to open; default: the soccer scenario")
                            ->check(someName());
    CLI::Option* runs =
        app.add_option("--run", run, "Open a scenario, run it for --ticks or --duration, and end")->check(someName());
    runs->excludes(file);
    app.add_flag("--offscreen,--headless", line.offscreen, "Use no display");
    CLI::Option* ticks =
        app.add_option("--ticks", line.ticks, "Run for so many ticks")->check(CLI::Range(0L, 1'000'000'000L));
    app.add_option("--duration", line.duration, "Run for so many seconds; default: as the scenario says")
        ->check(numberRange(0.0, 1e6))
        ->excludes(ticks);
    app.add_option("--at", line.at, "Open at this time, s; with a log: --start")->check(numberRange(0.0, 1e6));
    app.add_option("--seed", line.seed, "Seed of everything random; the same seed gives the same run")
        ->check(someSeed());
    app.add_option("--trial", line.trial,
                   "Start as this trial of a batch or an experiment does; default: as the scenario says, the "
                   "experiment's first")
        ->check(someTrial());
    app.add_option("--variant", line.variant, "Which variant of an experiment")->check(someName());
    app.add_option("--settings", line.settings,
                   "Puts the values of this file, such as `mrose tune` makes, into the scenario, before --set")
        ->check(someName())
        ->allow_extra_args(false);
    app.add_option("--set", line.overrides, "Overrides something in the scenario: PATH=VALUE")
        ->type_name("PATH=VALUE")
        ->allow_extra_args(false);
    app.add_option("--log", line.log,
                   "Lay this log over its simulation; of a scenario: read it instead of those that it names");
    CLI::Option* start =
        app.add_option("--start", line.start, "Where in the log to begin, s after its robots are there")
            ->check(numberRange(0.0, 1e7));
    app.add_option("--every", line.every,
                   "Start again from the real robots every so many s; default: 10, or windows as of `mrose evaluate` "
                   "where the log's trajectories are shorter")
        ->check(numberRange(0.1, 1e7));
    app.add_flag("--windows", line.windows, "Start where `mrose evaluate` does")->excludes(start);
    app.add_option("--robots", line.robots, "Only these robots of the log, by their names there: 1,2")->delimiter(',');
    app.add_option("--model", line.models,
                   "Lay another motion model over as well: a network's file, or a kinematic one")
        ->check(someName());
    app.add_option("--robot", line.robotFile,
                   "Robot file of the log's robots, where the log does not say it and no scenario is given");
    app.add_option("--plugin-limit", line.pluginLimit, "How long a plug-in may take for a decision, in s")
        ->check(numberRange(0.01, 1e6))
        ->capture_default_str();
    app.add_option("--speed", line.speed, "Times real time; 0: as fast as it goes")->check(numberRange(0.0, 1e6));
    app.add_option("--select", line.select, "Select a robot or object, by its name or its number from 1")
        ->check(someName());
    app.add_option("--layers", line.layers, "Show these layers and no others, with commas between them; or none")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(someLayer());
    app.add_option("--break", line.breaks,
                   "Stop where this condition begins to hold, or at contact, kick, goal, fault, breakHere(); may be "
                   "given several times. With --run it ends there and says when")
        ->allow_extra_args(false)
        ->check(someName());
    app.add_flag("--dark", line.dark, "Dark colours");
    app.add_flag("--remember", line.remember, "Use and keep the user's layout with --offscreen and --script, too");
    app.add_option("--size", size, "Of the window, pixels: 1280x800")->check(someSize());
    app.add_option("--script", line.script, "Lua file that drives the window; its expect() decides the exit status")
        ->check(someName());
    app.add_option("--screenshot", line.screenshot, "Save a picture of the window (.png, .svg or .pdf), and end")
        ->check(someName());
    app.add_option("--film", line.film, "Export what was run as a film (.mp4; needs ffmpeg), and end")
        ->check(someName());
    app.add_option("--record", line.record, "Write a recording (MCAP) while the run goes on")->check(someName());
    app.add_flag("--overwrite", line.overwrite, "Replace a recording that is there already");
    app.add_flag("--print-hash", line.printHash, "Print the last state's hash, as `mrose run` does");
    app.add_flag("--keys", line.printKeys, "Print all shortcuts");
}

}  // namespace

std::string flagOfALog(const CommandLine& line) {
    if (line.start) return "--start";
    if (line.every) return "--every";
    if (line.windows) return "--windows";
    if (!line.robots.empty()) return "--robots";
    if (!line.robotFile.empty()) return "--robot";
    return line.models.empty() ? "" : "--model";
}

ParsedCommandLine parseCommandLine(int argc, char** argv) {
    CLI::App app("The window: run, stop, step, rewind and branch what robots do.", "mrose-gui");
    app.footer(examples);
    app.set_version_flag("--version", versionText());
    app.failure_message([](const CLI::App*, const CLI::Error& error) {
        return std::string("mrose-gui: ") + error.what() + " (mrose-gui --help has more)\n";
    });
    ParsedCommandLine parsed;
    CommandLine& line = parsed.line;
    std::string run, size;
    addFlags(app, line, run, size);
    try {
        app.parse(argc, argv);
        line.run = !run.empty();
        if (line.run) line.file = run;
        if (!size.empty()) line.size = parseSize(size);
        if (line.ticks && !line.run) throw CLI::RequiresError("--ticks", "--run");
        if (const std::string flag = flagOfALog(line); line.run && !flag.empty())
            throw CLI::ValidationError(flag, "is for a log over its simulation; --run opens a scenario as it is");
        if (line.overwrite && line.record.empty()) throw CLI::RequiresError("--overwrite", "--record");
    } catch (const CLI::ParseError& error) {
        parsed.status = app.exit(error) == 0 ? 0 : usage;
    }
    return parsed;
}

}  // namespace mrose::gui
