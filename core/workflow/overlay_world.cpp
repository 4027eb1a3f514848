#include "workflow/overlay_world.h"

#include <algorithm>
#include <filesystem>

#include "assessment/log_scenario.h"
#include "assessment/rollout_value.h"
#include "io/file.h"
#include "io/format.h"
#include "logs/log_reader.h"
#include "scenario/scenario_file.h"
#include "workflow/notices.h"
#include "workflow/opening.h"
#include "workflow/plugin_process.h"
#include "workflow/resources.h"

namespace mrose {
namespace {

namespace fs = std::filesystem;

std::string fullPath(const std::string& place) {
    std::error_code ignored;
    return fs::absolute(place, ignored).lexically_normal().string();
}

Expected<std::shared_ptr<const Log>> logAt(const std::string& place, const std::optional<DifferentialDrive>& drive,
                                           const OpenProgress& progress) {
    if (!progress.goesOn()) return fail(place, "was not opened: cancelled");
    progress.reads(place);
    LogOptions options;
    if (drive) options.drive = *drive;
    auto log = readLog(place, options);
    if (!log) return tl::unexpected(log.error());
    if (!progress.goesOn()) return fail(place, "was not opened: cancelled");
    return std::make_shared<const Log>(std::move(*log));
}

/// `from` is a scenario's name or its value.
template <class From>
Expected<LoadedScenario> withoutLogs(const From& from, DiskDescriptions& source, const OverlayRequest& request,
                                     std::map<std::string, std::string>& files) {
    const PluginLoader isolated = [&](const std::string& path,
                                      const std::string& options) -> Expected<std::shared_ptr<const Controller>> {
        if (const auto content = readFile(path)) files[path] = contentHash(*content);
        return startPluginProcess(path, options, request.pluginLimit);
    };
    auto loaded = loadScenario(from, source, {isolated, false});
    if (!loaded) return loaded;
    for (const auto& [path, hash] : source.hashes()) files[path] = hash;
    return loaded;
}

/// The scenario that the request names, and the log beside it.
Expected<LoadedScenario> scenarioNamed(OverlayWorld& overlay, std::shared_ptr<const Log>& log,
                                       const OpenProgress& progress) {
    const OverlayRequest& request = overlay.request;
    DiskDescriptions source = openDescriptions(request.log.empty() ? "" : placeOfLog(request.log));
    auto loaded = request.kept ? withoutLogs(*request.kept, source, request, overlay.files)
                               : withoutLogs(request.scenario, source, request, overlay.files);
    if (!loaded) return loaded;
    if (loaded->parts.players.empty())
        return fail(source.shown(loaded->value.name()),
                    "plays no log; expected a robot with controller = { kind = \"log_player\", ... }");
    const auto place = source.logPlace(loaded->parts.players.front().excerpt);
    if (!place)
        return fail(source.shown(loaded->value.name()),
                    "its log \"" + loaded->parts.players.front().excerpt.reference +
                        "\" was not found; expected it in the folder that MROSE_DATA "
                        "names, or another one by --log");
    overlay.place = fullPath(place->string());
    const auto networks = networksOf(loaded->parts);
    auto read = logAt(overlay.place, networks.empty() ? std::nullopt : networks.front()->drive, progress);
    if (!read) return tl::unexpected(read.error());
    log = std::move(*read);
    return loaded;
}

/// A scenario that suits the log.
Expected<LoadedScenario> scenarioMade(OverlayWorld& overlay, std::shared_ptr<const Log>& log,
                                      const OpenProgress& progress, bool* kindUnknown) {
    const OverlayRequest& request = overlay.request;
    if (!request.robotFile.empty())
        if (const auto there = checkRobotFile(request.robotFile); !there) return tl::unexpected(there.error());
    overlay.place = fullPath(placeOfLog(request.log));
    auto read = logAt(overlay.place, {}, progress);
    if (!read) return tl::unexpected(read.error());
    log = std::move(*read);
    const auto kinds = robotKinds();
    if (!kinds) return tl::unexpected(kinds.error());
    if (auto playable = checkPlayable(*log, *kinds, request.robots); !playable) return tl::unexpected(playable.error());
    if (kindUnknown != nullptr) *kindUnknown = request.robotFile.empty() && !namesRobotKind(*log, *kinds);
    const auto made = scenarioOfLog(*log, overlay.place, *kinds, request.robotFile);
    if (!made) return tl::unexpected(made.error());
    DiskDescriptions disk = openDescriptions();
    auto loaded = withoutLogs(*made, disk, request, overlay.files);
    if (!loaded) return loaded;
    const auto networks = networksOf(loaded->parts);
    if (networks.empty() || !networks.front()->drive) return loaded;
    // Wheel commands are read by the geometry that the network was learned with.
    auto again = logAt(overlay.place, networks.front()->drive, progress);
    if (!again) return tl::unexpected(again.error());
    log = std::move(*again);
    return loaded;
}

void addNotices(OverlayWorld& overlay) {
    if (overlay.world().log().synthetic)
        overlay.notes.push_back(
            "The log comes from a simulated robot: nothing here says how true it is of a real one.");
    for (const std::vector<std::string>& more : {noticesOf(overlay.world().log()), overlay.world().leftOut()})
        overlay.notes.insert(overlay.notes.end(), more.begin(), more.end());
    for (const MotionNetwork* network : networksOf(overlay.world().parts()))
        for (std::string& notice : noticesOf(*network, overlay.world()))
            if (std::find(overlay.notes.begin(), overlay.notes.end(), notice) == overlay.notes.end())
                overlay.notes.push_back(std::move(notice));
}

/// A log of which only a part of the robots is known to the scenario is no mistake: those that both have are compared.
std::vector<std::string> sharedRobots(const OverlayRequest& request, const ScenarioParts& parts, const Log& log) {
    if (!request.robots.empty()) return request.robots;
    std::vector<std::string> shared, comparable;
    for (const LogPlayer& player : parts.players) {
        const auto real = std::find_if(log.robots.begin(), log.robots.end(),
                                       [&](const RobotLog& robot) { return robot.robot == player.excerpt.robot; });
        if (real == log.robots.end()) continue;
        shared.push_back(real->robot);
        if (hasBothSides(*real)) comparable.push_back(real->robot);
    }
    if (shared.size() == parts.players.size()) return {};
    return comparable.empty() ? shared : comparable;
}

}  // namespace

std::string OverlayWorld::name() const { return fs::path(place).filename().string(); }

Expected<OverlayWorldPointer> openOverlayWorld(const OverlayRequest& request, const OpenProgress& progress,
                                               bool* kindUnknown) {
    OverlayWorld opening{request, {}, {}, nullptr, 1, {}, {}};
    std::shared_ptr<const Log> log;
    auto loaded = request.scenario.empty() && !request.kept ? scenarioMade(opening, log, progress, kindUnknown)
                                                            : scenarioNamed(opening, log, progress);
    if (!loaded) return tl::unexpected(loaded.error());
    opening.value = std::make_shared<const ScenarioValue>(std::move(loaded->value));
    opening.seed = request.seed.value_or(loaded->parts.seed);
    const std::vector<std::string> shared = sharedRobots(request, loaded->parts, *log);
    auto world = LogWorld::create(std::move(loaded->parts), std::move(log), shared);
    if (!world) {
        if (world.error().file.empty()) world.error().file = opening.value->name();
        return tl::unexpected(world.error());
    }
    opening.played = std::make_shared<const LogWorld>(std::move(*world));
    for (const LogFile& file : opening.world().log().files) opening.files[file.path] = file.hash;
    addNotices(opening);
    return std::make_shared<const OverlayWorld>(std::move(opening));
}

std::string sessionText(const LogSession& session) { return session.name.empty() ? "" : "session " + session.name; }

std::string rolloutName(const OverlayWorld& overlay, const RolloutRequest& rollout) {
    const std::string session = sessionText(overlay.world().sessions()[rollout.session]);
    return overlay.name() + (session.empty() ? "" : ", " + session) + ", from " + fixed(toSeconds(rollout.start), 1) +
           " s";
}

Expected<OpenRun> openRollout(const OverlayWorld& overlay, const RolloutRequest& rollout, bool commandsToLogEnd) {
    const LogWorld& world = overlay.world();
    const Nanoseconds step = WindowOptions{}.step;
    const Nanoseconds left = world.sessions()[rollout.session].length - rollout.start;
    const Nanoseconds duration = commandsToLogEnd ? std::max(left, rollout.steps * step) : rollout.steps * step;
    auto opened =
        mrose::openRollout(world, *overlay.value, overlay.place, rollout, overlay.seed, rollout.steps * step, duration);
    if (!opened) return tl::unexpected(opened.error());
    OpenRun run{rolloutName(overlay, rollout), {}, nullptr, std::move(opened->state), {}, {}, {}, {}};
    run.source = {overlay.request.scenario.empty() ? overlay.place : overlay.request.scenario, 0, overlay.request.seed,
                  overlay.place, overlay.request.pluginLimit};
    run.setup = std::make_shared<const BranchSetup>(BranchSetup{std::move(opened->value), std::move(opened->scenario)});
    run.reality = std::make_shared<const Reality>(realityOf(world, rollout.session, rollout.start));
    run.files = overlay.files;
    return run;
}

}  // namespace mrose
