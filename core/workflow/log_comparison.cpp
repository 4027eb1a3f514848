#include "workflow/log_comparison.h"

#include <algorithm>

#include "assessment/log_scenario.h"
#include "io/format.h"
#include "workflow/log_files.h"
#include "workflow/notices.h"
#include "workflow/resources.h"
#include "workflow/version.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

/// What must be known before the figures are believed. `asked`: how long a rollout was to be.
std::vector<std::string> noticesAbout(const LogWorld& world, const Comparison& comparison,
                                      std::optional<Nanoseconds> asked) {
    std::vector<std::string> notices;
    if (world.log().synthetic)
        notices.push_back("The log comes from a simulated robot: nothing here says how true it is of a real one.");
    for (const std::vector<std::string>& more : {noticesOf(world.log()), world.leftOut()})
        notices.insert(notices.end(), more.begin(), more.end());
    const Nanoseconds length = comparison.requests.front().steps * comparison.log.options.step;
    if (asked && length < *asked)
        notices.push_back("The ground truth ends " + secondsText(length) +
                          " s after the start: compared up to there, not " + secondsText(*asked, 0) + " s.");
    for (const MotionNetwork* network : networksOf(world.parts()))
        for (std::string& notice : noticesOf(*network, world))
            if (std::find(notices.begin(), notices.end(), notice) == notices.end())
                notices.push_back(std::move(notice));
    return notices;
}

constexpr Nanoseconds windowLength = 10 * nanosecondsPerSecond;

/// Of a log whose trajectories are short, where nothing says which rollouts are meant: the same as in the window.
/// nullopt: one rollout, as long as the scenario says.
std::optional<std::vector<RolloutRequest>> suitedWindows(const LogComparisonRequest& request, const LogWorld& world) {
    const bool given =
        !request.scenario.empty() || !request.windows.empty() || request.start > 0 || request.duration || request.every;
    const auto length = given ? std::nullopt : windowsThatSuit(world, windowLength);
    if (!length) return {};
    auto rollouts = rolloutsOfAllWindows(world, *length);
    if (!rollouts) return {};
    return std::move(*rollouts);
}

Expected<std::vector<RolloutRequest>> rolloutsAsked(const LogComparisonRequest& request, const LogWorld& world) {
    if (request.windows.empty()) {
        StretchOptions options;
        options.start = fromSeconds(request.start);
        if (request.duration) options.duration = fromSeconds(*request.duration);
        if (request.every) options.every = fromSeconds(*request.every);
        if (!request.duration && !request.every)
            options.duration = std::max(options.step, world.parts().duration / options.step * options.step);
        return rolloutsOf(world, options);
    }
    const Nanoseconds length = request.duration ? fromSeconds(*request.duration) : windowLength,
                      step = WindowOptions{}.step;
    if (length % step != 0)
        return fail({}, secondsText(length) + " s is no whole number of steps of " + secondsText(step) + " s", 0,
                    "--duration");
    if (request.windows == allWindows) return rolloutsOfAllWindows(world, length);
    auto windows = readWindows(request.windows);
    if (!windows) return tl::unexpected(windows.error());
    return requestedRollouts(world, std::move(*windows), request.robots, static_cast<int>(length / step),
                             request.windows);
}

/// An error that names no file is of this one.
tl::unexpected<Error> errorOf(Error error, const std::string& file) {
    if (error.file.empty()) error.file = file;
    return tl::unexpected(std::move(error));
}

/// The scenario that is asked for, or one that suits the log.
Expected<LoadedScenario> scenarioFor(const LogComparisonRequest& request, const PluginLoader& plugins,
                                     DiskDescriptions& disk) {
    if (!request.scenario.empty()) return loadScenario(request.scenario, disk, {plugins, false});
    if (!request.robotFile.empty())
        if (const auto there = checkRobotFile(request.robotFile); !there) return tl::unexpected(there.error());
    const std::string place = placeOfLog(request.log);
    const auto log = openLog(place, {}, std::nullopt);
    if (!log) return tl::unexpected(log.error());
    const auto kinds = robotKinds();
    if (!kinds) return tl::unexpected(kinds.error());
    const auto made = scenarioOfLog(*log, place, *kinds, request.robotFile);
    if (!made) return tl::unexpected(made.error());
    return loadScenario(*made, disk, {plugins, false});
}

}  // namespace

Expected<LogComparison> compareLog(const LogComparisonRequest& request, const LogComparisonPlugins& plugins,
                                   const std::string& commandLine, const std::function<bool(double share)>& goesOn) {
    DiskDescriptions source = openDescriptions(request.log);
    auto loaded = scenarioFor(request, plugins.load, source);
    if (!loaded) return tl::unexpected(loaded.error());
    if (plugins.loaded) plugins.loaded(loaded->parts);
    const auto networks = networksOf(loaded->parts);
    auto opened = openLog(request.log, {}, networks.empty() ? std::nullopt : networks.front()->drive);
    if (!opened) return tl::unexpected(opened.error());
    const auto log = std::make_shared<const Log>(std::move(*opened));
    ComparisonOptions options;
    options.seed = request.seed.value_or(loaded->parts.seed);
    if (goesOn) options.progress = [&](std::span<const ComparedRollout>, double share) { return goesOn(share); };
    auto world = LogWorld::create(std::move(loaded->parts), log, request.robots);
    if (!world) return errorOf(world.error(), source.shown(loaded->value.name()));
    auto suited = suitedWindows(request, *world);
    const bool cut = suited.has_value();
    const auto requests =
        cut ? Expected<std::vector<RolloutRequest>>(std::move(*suited)) : rolloutsAsked(request, *world);
    if (!requests) return tl::unexpected(requests.error());
    auto comparison = compare(*world, *requests, options);
    if (!comparison) return errorOf(comparison.error(), source.shown(loaded->value.name()));
    const Nanoseconds step = comparison->log.options.step;
    std::optional<Nanoseconds> asked;
    if (request.windows.empty() && !request.every && !cut)
        asked = request.duration ? fromSeconds(*request.duration) : world->parts().duration / step * step;
    ReportContext context;
    context.program = "mrose " MROSE_VERSION;
    context.commandLine = commandLine;
    context.notices = noticesAbout(*world, *comparison, asked);
    if (cut)
        context.notices.push_back("The log's trajectories are short: compared in windows of " +
                                  secondsText(requests->front().steps * step) + " s, as `mrose evaluate` cuts them.");
    return LogComparison{std::move(*world), std::move(*comparison), std::move(context)};
}

}  // namespace mrose
