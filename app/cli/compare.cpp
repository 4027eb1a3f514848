#include "comparison/compare.h"

#include <cstdio>
#include <set>

#include "common.h"
#include "compare_divergence.h"
#include "comparison/comparison_files.h"
#include "comparison/comparison_report.h"
#include "evaluation/format.h"
#include "plugins.h"
#include "scenario/scenario_file.h"
#include "shared/notices.h"
#include "shared/resources.h"
#include "version.h"

namespace mrose::cli {
namespace {

struct CompareFlags {
    std::string scenario, log, windows, folder;
    std::vector<std::string> robots;
    double start = 0;
    std::optional<double> duration, every;
    std::optional<std::uint64_t> seed;
    PluginFlags plugins;
    DivergenceFlags divergence;
};

/// The networks that the scenario's log players move by.
std::vector<const MotionNetwork*> networksOf(const ScenarioParts& parts) {
    std::vector<const MotionNetwork*> networks;
    for (const LogPlayer& player : parts.players)
        if (const auto* learned = dynamic_cast<const LearnedModel*>(&parts.scene.modelOf(player.robot)))
            if (std::find(networks.begin(), networks.end(), &learned->network()) == networks.end())
                networks.push_back(&learned->network());
    return networks;
}

/// What must be known before the figures are believed. `asked`: how long a course was to be.
std::vector<std::string> noticesAbout(const LogWorld& world, const Comparison& comparison,
                                      std::optional<Nanoseconds> asked) {
    // Only the robots that are compared need to be known.
    Log compared = world.log();
    std::erase_if(compared.robots, [&](const RobotLog& robot) {
        return std::none_of(world.robots().begin(), world.robots().end(),
                            [&](const ComparedRobot& r) { return r.realName == robot.robot; });
    });
    std::vector<std::string> notices;
    if (compared.synthetic)
        notices.push_back("The log comes from a simulated robot: nothing here tells of a real one.");
    const Nanoseconds length = comparison.requests.front().steps * comparison.evaluation.options.windows.step;
    if (asked && length < *asked)
        notices.push_back("The ground truth ends " + secondsText(length) +
                          " s after the start: compared up to there, not " + secondsText(*asked, 0) + " s.");
    for (const MotionNetwork* network : networksOf(world.parts()))
        for (std::string& notice : noticesOf(*network, compared))
            if (std::find(notices.begin(), notices.end(), notice) == notices.end())
                notices.push_back(std::move(notice));
    return notices;
}

Expected<std::vector<CourseRequest>> coursesAsked(const CompareFlags& flags, const LogWorld& world) {
    constexpr double windowLength = 10;
    if (flags.windows.empty()) {
        StretchOptions options;
        options.start = fromSeconds(flags.start);
        if (flags.duration) options.duration = fromSeconds(*flags.duration);
        if (flags.every) options.every = fromSeconds(*flags.every);
        if (!flags.duration && !flags.every)
            options.duration = std::max(options.step, world.parts().duration / options.step * options.step);
        return coursesOf(world, options);
    }
    auto windows = readWindows(flags.windows);
    if (!windows) return tl::unexpected(windows.error());
    const Nanoseconds length = fromSeconds(flags.duration.value_or(windowLength)), step = WindowOptions{}.step;
    if (length % step != 0)
        return fail({}, secondsText(length) + " s is no whole number of steps of " + secondsText(step) + " s", 0,
                    "--duration");
    return requestedCourses(world, std::move(*windows), flags.robots, static_cast<int>(length / step), flags.windows);
}

void printComparison(const Comparison& comparison, const ComparedDivergences& divergences,
                     const std::vector<std::string>& notices) {
    const Nanoseconds step = comparison.evaluation.options.windows.step;
    const CourseRequest& first = comparison.requests.front();
    const bool one = comparison.requests.size() == 1;
    std::printf("%s beside %s, seed %llu: %s of %s s, %sfrom %s s on\n\n", comparison.scenario.c_str(),
                comparison.evaluation.source.c_str(), static_cast<unsigned long long>(comparison.seed),
                one ? "a course" : (std::to_string(comparison.requests.size()) + " courses").c_str(),
                secondsText(first.steps * step, 0).c_str(), one ? "" : "the first ",
                secondsText(first.start, 0).c_str());
    TextTable table({"", "courses", "windows", "P %", "Hd %", "final cm", "final deg", "touches"});
    const auto add = [&](const std::string& name, const ComparedSummary& s) {
        table.add({name, std::to_string(s.courses()), std::to_string(s.of(CourseUse::counted)), fixed(s.counted.p, 2),
                   fixed(s.counted.hd, 2), fixed(100 * s.positionFinal.median, 2),
                   fixed(degrees * s.headingFinal.median, 2), std::to_string(s.touches)});
    };
    for (std::size_t i = 0; i < comparison.robots.size(); ++i) add(comparison.robots[i].name, comparison.summaries[i]);
    if (comparison.robots.size() > 1) add("all", comparison.all);
    std::fputs(table.text().c_str(), stdout);
    std::puts(
        "\nwindows: courses with ground truth throughout in which the robot moves; P: time-mean position error over "
        "path,\nHd: time-mean heading error over rotation, summed over these windows. final: median errors at the end "
        "of "
        "the\ncourses. touches: how often the simulated robot began to touch something.");
    printDivergences(comparison, divergences);
    std::vector<std::string> notes = notices;
    for (std::string& remark : remarksOn(comparison)) notes.push_back(std::move(remark));
    if (!notes.empty()) std::puts("");
    for (const std::string& note : notes) std::printf("Note: %s\n", note.c_str());
}

int deliver(const Comparison& comparison, const ComparedDivergences& divergences, const LogWorld& world,
            const CompareFlags& flags, const CommonFlags& common) {
    const Nanoseconds step = comparison.evaluation.options.windows.step;
    std::optional<Nanoseconds> asked;
    ReportContext context;
    context.program = "mrose " MROSE_VERSION;
    context.commandLine = commandLine();
    context.synthetic = world.log().synthetic;
    if (flags.windows.empty() && !flags.every)
        asked = flags.duration ? fromSeconds(*flags.duration) : world.parts().duration / step * step;
    context.notices = noticesAbout(world, comparison, asked);
    if (common.json)
        std::fputs(comparisonJson(comparison, context.notices, &divergences).c_str(), stdout);
    else
        printComparison(comparison, divergences, context.notices);
    if (flags.folder.empty()) return success;
    if (const auto written = writeComparison(comparison, world.parts().scene, context, flags.folder, &divergences);
        !written)
        return report(written.error());
    if (!common.json)
        std::printf("\nreport: %s\n", (std::filesystem::path(flags.folder) / "report.html").string().c_str());
    return success;
}

int compareScenario(const CompareFlags& flags, const CommonFlags& common) {
    if (!flags.folder.empty())
        if (const auto writable = checkComparisonFolder(flags.folder, common.overwrite); !writable)
            return report(writable.error());
    watchInterrupts();
    DiskDescriptions source = openDescriptions(flags.log);
    auto loaded = loadScenario(flags.scenario, source, {pluginLoader(flags.plugins), false});
    if (!loaded) return report(loaded.error());
    watchPlugins(loaded->parts);
    const auto networks = networksOf(loaded->parts);
    const auto log = openLog(placeOfLog(flags.log), {}, networks.empty() ? std::nullopt : networks.front()->drive);
    if (!log) return report(log.error());
    ComparisonOptions options;
    options.seed = flags.seed.value_or(loaded->parts.seed);
    const auto world = LogWorld::create(std::move(loaded->parts), *log, flags.robots);
    if (!world) return report(world.error(), source.shown(loaded->name));
    const auto requests = coursesAsked(flags, *world);
    if (!requests) return report(requests.error());
    const auto comparison = compare(*world, *requests, options);
    if (!comparison) return report(comparison.error(), source.shown(loaded->name));
    const auto divergences = findDivergences(*world, *comparison, flags.divergence, common.quiet);
    if (!divergences) return report(divergences.error(), source.shown(loaded->name));
    if (divergences->cancelled) {
        std::fprintf(stderr, "mrose: interrupted; nothing written\n");
        return interrupted;
    }
    return deliver(*comparison, *divergences, *world, flags, common);
}

}  // namespace

Subcommand addCompare(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<CompareFlags>();
    CLI::App* sub = addSubcommand(
        app, common, "compare", "Put simulated robots beside the real ones whose log they play, with their errors",
        "  mrose compare mrclam_replay.toml --log MRCLAM_Dataset6\n"
        "  mrose compare mrclam_replay.toml --log MRCLAM_Dataset6 --every 10 --report comparison\n"
        "  mrose compare mrclam_replay.toml --log MRCLAM_Dataset7 --robots 1,2 --start 120 --duration 30\n"
        "  mrose compare mrclam_replay.toml --log MRCLAM_Dataset7 --robots 1,2 --windows windows.csv\n"
        "  mrose compare mrclam_replay.toml --log MRCLAM_Dataset6 --start 120 --duration 60 --model mine.net\n"
        "Each course begins with the poses and velocities of the real robots and the commands before; from there on "
        "the "
        "simulation gets their commands alone. It collides with what is in the world; mrose predict knows no "
        "contacts.");
    addSeed(*sub, common);
    addThreads(*sub, common);
    addOverwrite(*sub, common);
    sub->add_option("SCENARIO", flags->scenario,
                    "Scenario file, or the name of one that ships, with robots that play a log")
        ->required();
    sub->get_option("--seed")->default_str("the scenario's");
    sub->add_option("--log", flags->log, "The log to play and to compare with")->required();
    sub->add_option("--robots", flags->robots,
                    "Only these robots, by their names in the log: 1,2; the others are not in the world")
        ->delimiter(',');
    CLI::Option* start =
        sub->add_option("--start", flags->start, "Where in the log to begin, in s after all of its robots are there")
            ->check(numberRange(0.0, 1e7))
            ->capture_default_str();
    sub->add_option("--duration", flags->duration,
                    "How long to compare, in s; otherwise what the scenario says, with --every to the log's end, with "
                    "--windows 10")
        ->check(numberRange(0.1, 1e7));
    CLI::Option* every = sub->add_option("--every", flags->every, "Start again from the real robots every so many s")
                             ->check(numberRange(0.1, 1e7));
    sub->add_option("--windows", flags->windows,
                    "CSV file that says which windows, as for mrose predict: a course for each")
        ->excludes(start)
        ->excludes(every);
    sub->add_option("--report", flags->folder, "Folder for report.html, errors.csv, courses.csv and results.json")
        ->check(someName());
    addDivergenceFlags(*sub, flags->divergence);
    addPluginFlags(*sub, flags->plugins);
    sub->callback([sub, flags, &common] {
        if (sub->count("--seed") > 0) flags->seed = common.seed;
    });
    return {sub, [flags, &common] { return compareScenario(*flags, common); }};
}

}  // namespace mrose::cli
