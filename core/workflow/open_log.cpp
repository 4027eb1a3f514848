#include "workflow/open_log.h"

#include <algorithm>
#include <filesystem>

#include "assessment/log_scenario.h"
#include "io/file.h"
#include "io/format.h"
#include "logs/log_reader.h"
#include "scenario/scenario_file.h"
#include "workflow/notices.h"
#include "workflow/plugins.h"
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
Expected<LoadedScenario> withoutLogs(const From& from, DiskDescriptions& source, const PlayedLogRequest& request,
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
Expected<LoadedScenario> scenarioNamed(PlayedLog& played, std::shared_ptr<const Log>& log,
                                       const OpenProgress& progress) {
    const PlayedLogRequest& request = played.request;
    DiskDescriptions source = openDescriptions(request.log.empty() ? "" : placeOfLog(request.log));
    auto loaded = request.kept ? withoutLogs(*request.kept, source, request, played.files)
                               : withoutLogs(request.scenario, source, request, played.files);
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
    played.place = fullPath(place->string());
    const auto networks = networksOf(loaded->parts);
    auto read = logAt(played.place, networks.empty() ? std::nullopt : networks.front()->drive, progress);
    if (!read) return tl::unexpected(read.error());
    log = std::move(*read);
    return loaded;
}

/// A scenario that suits the log.
Expected<LoadedScenario> scenarioMade(PlayedLog& played, std::shared_ptr<const Log>& log, const OpenProgress& progress,
                                      bool* kindUnknown) {
    const PlayedLogRequest& request = played.request;
    if (!request.robotFile.empty())
        if (const auto there = checkRobotFile(request.robotFile); !there) return tl::unexpected(there.error());
    const auto place = existingLog(request.log);
    if (!place) return tl::unexpected(place.error());
    played.place = fullPath(*place);
    auto read = logAt(played.place, {}, progress);
    if (!read) return tl::unexpected(read.error());
    log = std::move(*read);
    const auto kinds = robotKinds();
    if (!kinds) return tl::unexpected(kinds.error());
    if (auto playable = checkPlayable(*log, *kinds, request.robots); !playable) return tl::unexpected(playable.error());
    if (kindUnknown != nullptr) *kindUnknown = request.robotFile.empty() && !namesRobotKind(*log, *kinds);
    const auto made = scenarioOfLog(*log, played.place, *kinds, request.robotFile);
    if (!made) return tl::unexpected(made.error());
    DiskDescriptions disk = openDescriptions();
    auto loaded = withoutLogs(*made, disk, request, played.files);
    if (!loaded) return loaded;
    const auto networks = networksOf(loaded->parts);
    if (networks.empty() || !networks.front()->drive) return loaded;
    // Wheel commands are read by the geometry that the network was learned with.
    auto again = logAt(played.place, networks.front()->drive, progress);
    if (!again) return tl::unexpected(again.error());
    log = std::move(*again);
    return loaded;
}

void addNotices(PlayedLog& played) {
    if (played.world().log().synthetic)
        played.notes.push_back("The log comes from a simulated robot: nothing here says how true it is of a real one.");
    for (const std::vector<std::string>& more : {noticesOf(played.world().log()), played.world().leftOut()})
        played.notes.insert(played.notes.end(), more.begin(), more.end());
    for (const MotionNetwork* network : networksOf(played.world().parts()))
        for (std::string& notice : noticesOf(*network, played.world()))
            if (std::find(played.notes.begin(), played.notes.end(), notice) == played.notes.end())
                played.notes.push_back(std::move(notice));
}

/// A log of which only a part of the robots is known to the scenario is no mistake: those that both have are compared.
std::vector<std::string> sharedRobots(const PlayedLogRequest& request, const ScenarioParts& parts, const Log& log) {
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

bool isSameRollout(const LogWorld& before, const RolloutRequest& was, const LogWorld& now, const RolloutRequest& is) {
    if (was.start != is.start || was.robot.has_value() != is.robot.has_value()) return false;
    if (was.robot && before.robots()[*was.robot].name != now.robots()[*is.robot].name) return false;
    return before.trajectory(was.session, 0).name == now.trajectory(is.session, 0).name;
}

}  // namespace

Expected<PlayedLogPointer> openPlayedLog(const PlayedLogRequest& request, const OpenProgress& progress,
                                         bool* kindUnknown) {
    PlayedLog opening{request, {}, {}, nullptr, 1, {}, {}};
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
    return std::make_shared<const PlayedLog>(std::move(opening));
}

Expected<OpenedLog> openLogAsRun(const PlayedLogRequest& request, const std::optional<RolloutPlan>& asked,
                                 bool restarts, const OpenProgress& progress, bool* kindUnknown) {
    auto world = openPlayedLog(request, progress, kindUnknown);
    if (!world) return tl::unexpected(world.error());
    const RolloutPlan plan = asked ? *asked : suitedPlan(**world);
    auto requests = plannedRollouts(**world, plan);
    if (!requests) return tl::unexpected(requests.error());
    auto run = openRollout(**world, requests->front(), playsToLogEnd(plan, restarts));
    if (!run) return tl::unexpected(run.error());
    return OpenedLog{std::move(*world), plan, std::move(*requests), 0, std::move(*run)};
}

Expected<OpenedLog> reopen(const PlayedLog& before, const RolloutPlan& plan, const RolloutRequest& shown, bool restarts,
                           const OpenProgress& progress) {
    auto world = openPlayedLog(before.request, progress);
    if (!world) return tl::unexpected(world.error());
    auto requests = plannedRollouts(**world, plan);
    if (!requests) return tl::unexpected(requests.error());
    const auto same = std::find_if(requests->begin(), requests->end(), [&](const RolloutRequest& request) {
        return isSameRollout(before.world(), shown, (*world)->world(), request);
    });
    if (same == requests->end()) {
        const std::string& session = before.world().trajectory(shown.session, 0).name;
        return fail((*world)->place, "has no rollout from " + secondsText(shown.start) + " s" +
                                         (session.empty() ? "" : " of \"" + session + '"') + " any more");
    }
    auto run = openRollout(**world, *same, playsToLogEnd(plan, restarts));
    if (!run) return tl::unexpected(run.error());
    const auto rollout = static_cast<std::size_t>(same - requests->begin());
    return OpenedLog{std::move(*world), plan, std::move(*requests), rollout, std::move(*run)};
}

}  // namespace mrose
