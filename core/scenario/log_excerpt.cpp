#include "scenario/log_excerpt.h"

#include <algorithm>

#include "io/number_text.h"
#include "logs/csv_reader.h"
#include "logs/csv_writer.h"
#include "logs/pose_grid.h"

namespace mrose {
namespace {

/// The longest dead time that a model may read back, generously.
constexpr Nanoseconds before = 3 * nanosecondsPerSecond;
/// A robot whose log has ended is told to stand, as soon as its last command could have been followed by another.
constexpr Nanoseconds after = nanosecondsPerSecond / 2;

Expected<const Trajectory*> find(const Log& log, const LogExcerpt& excerpt) {
    const auto robot =
        std::find_if(log.robots.begin(), log.robots.end(), [&](const RobotLog& r) { return r.robot == excerpt.robot; });
    if (robot == log.robots.end()) return fail(log.source, "has no robot \"" + excerpt.robot + '"');
    for (const Trajectory& trajectory : robot->trajectories) {
        if (!excerpt.trajectory.empty() && trajectory.name != excerpt.trajectory) continue;
        if (trajectory.commands.empty()) return fail(log.source, "has no commands of robot \"" + excerpt.robot + '"');
        return &trajectory;
    }
    return fail(log.source, "has no trajectory \"" + excerpt.trajectory + "\" of robot \"" + excerpt.robot + '"');
}

Nanoseconds startOf(const Log& log, const Trajectory& chosen, const LogExcerpt& excerpt) {
    Nanoseconds start = beginning(chosen);
    if (excerpt.trajectory.empty())
        for (const RobotLog& robot : log.robots)
            if (!robot.trajectories.empty()) start = std::max(start, beginning(robot.trajectories.front()));
    return start + fromSeconds(excerpt.start);
}

/// Those that change the command in force, from the one in force at `from` on; at last a stop.
std::vector<StampedCommand> changes(const std::vector<StampedCommand>& commands, Nanoseconds from) {
    std::vector<StampedCommand> kept;
    for (const StampedCommand& issued : commands) {
        if (issued.time <= from) kept.clear();
        if (kept.empty() || !identical(kept.back().command, issued.command)) kept.push_back(issued);
    }
    kept.push_back({commands.back().time + after, {}});
    return kept;
}

}  // namespace

Nanoseconds beginning(const Trajectory& trajectory) {
    if (trajectory.commands.empty()) return 0;
    const Nanoseconds commanded = trajectory.commands.front().time;
    return trajectory.poses.empty() ? commanded : std::max(commanded, trajectory.poses.front().time);
}

Expected<std::string> excerptText(const Log& log, const LogExcerpt& excerpt) {
    const auto found = find(log, excerpt);
    if (!found) return tl::unexpected(found.error());
    const Trajectory& whole = **found;
    const Nanoseconds start = startOf(log, whole, excerpt);
    if (start < beginning(whole))
        return fail(log.source, "robot \"" + excerpt.robot + "\" begins " +
                                    numberText(toSeconds(beginning(whole) - start)) + " s later than " +
                                    numberText(excerpt.start) + " s from the log's start; expected a later start");
    if (start >= whole.commands.back().time)
        return fail(log.source, "robot \"" + excerpt.robot + "\" has no commands after " + numberText(excerpt.start) +
                                    " s from the log's start");
    Trajectory part{.name = whole.name};
    if (whole.poses.empty()) {
        part.commands = changes(whole.commands, start);
        part.commands.front().time = std::max(part.commands.front().time, start);
    } else {
        part.commands = changes(whole.commands, start - before);
        part.poses = {{start, truthAt(whole.poses, start)}};
    }
    Log text;
    text.synthetic = log.synthetic;
    text.robots.push_back({excerpt.robot, {std::move(part)}, {}});
    return toCsv(text);
}

Expected<ExcerptContent> parseExcerpt(std::string_view text, const std::string& name) {
    LogOptions options;
    options.dropBlips = false;
    const auto log = parseCsv(text, name, options);
    if (!log) return tl::unexpected(log.error());
    if (log->robots.size() != 1 || log->robots[0].trajectories.size() != 1 ||
        log->robots[0].trajectories[0].commands.empty())
        return fail(name, "expected the commands of one robot");
    const Trajectory& trajectory = log->robots[0].trajectories[0];
    ExcerptContent content{trajectory.commands, std::nullopt};
    const bool tracked = !trajectory.poses.empty();
    if (tracked) content.start = trajectory.poses.front().pose;
    const Nanoseconds start = tracked ? trajectory.poses.front().time : trajectory.commands.front().time;
    for (StampedCommand& command : content.commands) command.time -= start;
    return content;
}

}  // namespace mrose
