#include "assessment/rollout_requests.h"

#include <algorithm>

#include "io/format.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

/// The session and compared robot of each robot that plays this trajectory from this instant.
void addRollouts(const LogWorld& world, const RolloutStart& start, std::vector<RolloutRequest>& rollouts) {
    std::vector<bool> found(world.robots().size());
    for (std::size_t session = 0; session < world.sessions().size(); ++session)
        for (std::size_t robot = 0; robot < world.robots().size(); ++robot) {
            if (found[robot] || &world.trajectory(session, robot) != start.trajectory) continue;
            found[robot] = true;
            rollouts.push_back(
                {session, start.time - world.sessions()[session].parts[robot].origin, start.steps, robot});
        }
}

Expected<void> checkWhole(Nanoseconds duration, Nanoseconds step, const char* key) {
    if (duration > 0 && duration % step == 0) return {};
    return fail({}, secondsText(duration) + " s is no whole number of steps of " + secondsText(step) + " s", 0, key);
}

}  // namespace

Expected<std::vector<RolloutRequest>> rolloutsOf(const LogWorld& world, const StretchOptions& options) {
    if (options.every)
        if (const auto whole = checkWhole(*options.every, options.step, "--every"); !whole)
            return tl::unexpected(whole.error());
    if (options.duration)
        if (const auto whole = checkWhole(*options.duration, options.step, "--duration"); !whole)
            return tl::unexpected(whole.error());
    std::vector<RolloutRequest> rollouts;
    Nanoseconds longest = 0;
    for (std::size_t session = 0; session < (options.every ? world.sessions().size() : 1); ++session) {
        const Nanoseconds length = world.sessions()[session].length;
        longest = std::max(longest, length);
        const Nanoseconds end = options.duration ? std::min(length, options.start + *options.duration) : length;
        const Nanoseconds left = (end - options.start) / options.step * options.step;
        const Nanoseconds rollout = options.every.value_or(left);
        if (rollout <= 0) continue;
        for (Nanoseconds at = options.start; at + rollout <= end; at += rollout)
            rollouts.push_back({session, at, static_cast<int>(rollout / options.step)});
    }
    if (!rollouts.empty()) return rollouts;
    const std::string end = "the ground truth ends " + secondsText(longest) + " s after the log's start";
    if (longest < options.step)
        return fail(world.log().source, end + "; expected a log that goes on for at least " +
                                            secondsText(options.step) + " s once all of its robots are there");
    if (options.start + options.step > longest)
        return fail(world.log().source,
                    end + "; expected an earlier --start than " + secondsText(options.start) + " s");
    return fail(world.log().source, end + "; expected a shorter --every than " +
                                        secondsText(options.every.value_or(0)) + " s, no longer than --duration");
}

std::vector<RolloutRequest> rolloutsOfWindows(const LogWorld& world, std::span<const Window> windows) {
    std::vector<RolloutRequest> rollouts;
    for (const Window& window : windows) {
        const Trajectory& trajectory = world.log().robots[window.robot].trajectories[window.trajectory];
        addRollouts(world, {.trajectory = &trajectory, .time = window.start, .steps = window.steps()}, rollouts);
    }
    return rollouts;
}

Expected<std::vector<RolloutRequest>> rolloutsOfAllWindows(const LogWorld& world, Nanoseconds length) {
    WindowOptions options;
    options.horizon = length;
    std::vector<std::string> robots;
    for (const ComparedRobot& robot : world.robots()) robots.push_back(robot.realName);
    const auto windows = findWindows(world.log(), robots, options);
    if (!windows) return tl::unexpected(windows.error());
    auto rollouts = rolloutsOfWindows(world, *windows);
    if (rollouts.empty()) return fail(world.log().source, "has no window of the scenario's robots");
    return rollouts;
}

std::optional<Nanoseconds> windowsThatSuit(const LogWorld& world, Nanoseconds every) {
    Nanoseconds driven = 0, covered = 0;
    std::vector<Nanoseconds> lengths;
    for (std::size_t session = 0; session < world.sessions().size(); ++session) {
        const Nanoseconds length = std::max<Nanoseconds>(0, world.sessions()[session].length);
        driven += length;
        covered += length / every * every;
        for (std::size_t robot = 0; robot < world.robots().size(); ++robot) {
            const std::vector<StampedPose>& poses = world.trajectory(session, robot).poses;
            lengths.push_back(poses.back().time - poses.front().time);
        }
    }
    if (2 * covered >= driven) return {};
    std::sort(lengths.begin(), lengths.end());
    const Nanoseconds step = WindowOptions{}.step;
    return std::clamp(lengths[lengths.size() / 10] / step * step, step, every);
}

Expected<std::vector<RolloutRequest>> requestedRollouts(const LogWorld& world, std::vector<WindowRequest> windows,
                                                        const std::vector<std::string>& robots, int steps,
                                                        const std::string& fileName) {
    if (!robots.empty())
        std::erase_if(windows, [&](const WindowRequest& window) {
            return std::find(robots.begin(), robots.end(), window.robot) == robots.end();
        });
    if (windows.empty()) return fail(fileName, "has no window of the robots that --robots names");
    const auto requested = requestedStarts(world.log(), windows, steps, fileName);
    if (!requested) return tl::unexpected(requested.error());
    std::vector<RolloutRequest> rollouts;
    for (std::size_t i = 0; i < windows.size(); ++i) {
        const std::size_t before = rollouts.size();
        addRollouts(world, requested->starts[i], rollouts);
        if (rollouts.size() == before)
            return fail(fileName,
                        "the scenario plays no robot " + windows[i].robot +
                            " there; expected windows of its robots, or --robots with those that it plays",
                        windows[i].line, "robot");
    }
    return rollouts;
}

}  // namespace mrose
