#include "debug/played_log.h"

#include <algorithm>
#include <filesystem>

#include "assessment/rollout_value.h"
#include "io/format.h"

namespace mrose {

std::string PlayedLog::name() const { return std::filesystem::path(place).filename().string(); }

std::string sessionText(const LogSession& session) { return session.name.empty() ? "" : "session " + session.name; }

std::string rolloutName(const PlayedLog& log, const RolloutRequest& rollout) {
    const std::string session = sessionText(log.world().sessions()[rollout.session]);
    return log.name() + (session.empty() ? "" : ", " + session) + ", from " + fixed(toSeconds(rollout.start), 1) + " s";
}

Expected<OpenedRun> openRollout(const PlayedLog& log, const RolloutRequest& rollout, bool commandsToLogEnd) {
    const LogWorld& world = log.world();
    const Nanoseconds step = WindowOptions{}.step;
    const Nanoseconds left = world.sessions()[rollout.session].length - rollout.start;
    const Nanoseconds duration = commandsToLogEnd ? std::max(left, rollout.steps * step) : rollout.steps * step;
    auto opened = mrose::openRollout(world, *log.value, log.place, rollout, log.seed, rollout.steps * step, duration);
    if (!opened) return tl::unexpected(opened.error());
    OpenedRun run{rolloutName(log, rollout), {}, nullptr, std::move(opened->state), {}, {}, {}, {}};
    run.source = {log.request.scenario.empty() ? log.place : log.request.scenario, 0, log.request.seed, log.place,
                  log.request.pluginLimit};
    run.setup = std::make_shared<const BranchSetup>(BranchSetup{std::move(opened->value), std::move(opened->scenario)});
    run.reality = std::make_shared<const Reality>(realityOf(world, rollout.session, rollout.start));
    run.files = log.files;
    return run;
}

}  // namespace mrose
