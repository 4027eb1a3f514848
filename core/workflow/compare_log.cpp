#include "workflow/compare_log.h"

#include <algorithm>

#include "assessment/log_scenario.h"
#include "identification/sensor_inspection.h"
#include "io/format.h"
#include "workflow/log_files.h"
#include "workflow/motion_models.h"
#include "workflow/notices.h"
#include "workflow/resources.h"
#include "workflow/version.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

/// Robots whose real sensors are often far off the ground truth: gross errors, as where a sensor is inspected.
std::vector<std::string> misfitNotices(const Comparison& comparison) {
    std::vector<std::string> notices;
    for (const ComparedSensor& sensor : comparison.sensors)
        for (std::size_t robot = 0; robot < comparison.robots.size(); ++robot) {
            std::size_t readings = 0, gross = 0;
            for (const SensedLook& look : sensor.looks.real)
                for (const SensedSubject& subject : look.subjects) {
                    if (look.robot != robot || !subject.reported) continue;
                    ++readings;
                    gross += isGross(subject.rangeError, subject.bearingError);
                }
            if (20 * gross > readings)
                notices.push_back(
                    "Robot " + comparison.robots[robot].realName + ": " + std::to_string(gross) + " of " +
                    counted(readings, "reading") + " of \"" + sensor.name +
                    "\" are more than 1 m or 0.15 rad off the truth" +
                    (2 * gross > readings ? "; are their stamps of another clock, or columns swapped?" : "."));
        }
    return notices;
}

/// What must be known before the figures are believed. `asked`: how long a rollout was to be.
std::vector<std::string> noticesAbout(const LogWorld& world, const Comparison& comparison,
                                      std::optional<Nanoseconds> asked) {
    std::vector<std::string> notices;
    if (world.log().synthetic)
        notices.push_back("The log comes from a simulated robot: nothing here says how true it is of a real one.");
    for (const std::vector<std::string>& more : {noticesOf(world.log()), world.leftOut(), misfitNotices(comparison)})
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
std::optional<std::vector<RolloutRequest>> suitedWindows(const CompareRequest& request, const LogWorld& world) {
    const bool given =
        !request.scenario.empty() || !request.windows.empty() || request.start > 0 || request.duration || request.every;
    const auto length = given ? std::nullopt : windowsThatSuit(world, windowLength);
    if (!length) return {};
    auto rollouts = rolloutsOfAllWindows(world, *length);
    if (!rollouts) return {};
    return std::move(*rollouts);
}

Expected<std::vector<RolloutRequest>> rolloutsAsked(const CompareRequest& request, const LogWorld& world) {
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

/// The scenario that is asked for, or one that suits the log.
Expected<LoadedScenario> scenarioFor(const CompareRequest& request, DiskDescriptions& disk) {
    const PluginLoader plugins = pluginLoader(request.plugins);
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

Expected<DivergenceOptions> divergenceOptions(const LogWorld& world, const DivergenceRequest& request) {
    DivergenceOptions options;
    options.bound.held = fromSeconds(request.held);
    options.fromNetwork = !request.position && !request.heading;
    if (request.position) options.bound.constant.position = *request.position;
    if (request.heading) options.bound.constant.heading = *request.heading / degrees;
    if (request.noCauses) {
        options.diagnosed = 0;
        return options;
    }
    auto models = modelsToTry(world, request.models);
    if (!models) return tl::unexpected(models.error());
    options.models = std::move(*models);
    return options;
}

/// The scenario with the log that it plays.
struct LoadedWorld {
    LogWorld world;
    std::string scenario;  ///< its file's name, as errors have it
};

Expected<LoadedWorld> openWorld(const CompareRequest& request, std::uint64_t& seed) {
    DiskDescriptions source = openDescriptions(request.log);
    auto loaded = scenarioFor(request, source);
    if (!loaded) return tl::unexpected(loaded.error());
    if (request.plugins.loaded) request.plugins.loaded(loaded->parts);
    const auto networks = networksOf(loaded->parts);
    auto log = openLog(request.log, {}, networks.empty() ? std::nullopt : networks.front()->drive);
    if (!log) return tl::unexpected(log.error());
    seed = request.seed.value_or(loaded->parts.seed);
    const std::string shown = source.shown(loaded->value.name());
    auto world =
        LogWorld::create(std::move(loaded->parts), std::make_shared<const Log>(std::move(*log)), request.robots);
    if (!world) return atFile(world.error(), shown);
    return LoadedWorld{std::move(*world), shown};
}

}  // namespace

Expected<LogComparison> compareLog(const CompareRequest& request, const CompareProgress& progress) {
    ComparisonOptions options;
    auto played = openWorld(request, options.seed);
    if (!played) return tl::unexpected(played.error());
    const LogWorld& world = played->world;
    options.readings = true;
    auto suited = suitedWindows(request, world);
    const bool cut = suited.has_value();
    const auto requests =
        cut ? Expected<std::vector<RolloutRequest>>(std::move(*suited)) : rolloutsAsked(request, world);
    if (!requests) return tl::unexpected(requests.error());
    auto bounds = divergenceOptions(world, request.divergence);
    if (!bounds) return tl::unexpected(bounds.error());
    bounds->progress = progress.diagnoses;
    options.progress = [&](std::span<const ComparedRollout>, double share) { return mayGoOn(progress.drives, share); };
    auto comparison = compare(world, *requests, options);
    if (!comparison) return atFile(comparison.error(), played->scenario);
    auto divergences = divergencesOf(world, *comparison, *bounds);
    if (!divergences) return atFile(divergences.error(), comparison->scenario);
    if (divergences->cancelled) return fail(world.log().source, "was not compared: cancelled");
    const Nanoseconds step = comparison->log.options.step;
    std::optional<Nanoseconds> asked;
    if (request.windows.empty() && !request.every && !cut)
        asked = request.duration ? fromSeconds(*request.duration) : world.parts().duration / step * step;
    ReportContext context;
    context.program = "mrose " MROSE_VERSION;
    context.commandLine = request.command;
    context.notices = noticesAbout(world, *comparison, asked);
    if (cut)
        context.notices.push_back("The log's trajectories are short: compared in windows of " +
                                  secondsText(requests->front().steps * step) + " s, as `mrose evaluate` cuts them.");
    return LogComparison{std::move(played->world), std::move(*comparison), std::move(*divergences), std::move(context)};
}

}  // namespace mrose
