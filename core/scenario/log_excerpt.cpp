#include "scenario/log_excerpt.h"

#include <algorithm>
#include <cmath>

#include "io/bytes.h"
#include "io/format.h"
#include "logs/csv_reader.h"
#include "logs/pose_grid.h"
#include "motion/motion_model.h"

namespace mrose {
namespace {

/// A robot whose log has ended is commanded to stand, as soon as its last command could have been followed by another.
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

Expected<ExcerptContent> excerptOf(const Log& log, const LogExcerpt& excerpt) {
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
    ExcerptContent content;
    if (whole.poses.empty()) {
        content.commands = changes(whole.commands, start);
        content.commands.front().time = std::max(content.commands.front().time, start);
    } else {
        content.commands = changes(whole.commands, start - commandsKnownBefore);
        content.start = truthAt(whole.poses, start);
    }
    // Without ground truth the run begins with its first command.
    const Nanoseconds zero = content.start ? start : content.commands.front().time;
    for (StampedCommand& command : content.commands) command.time -= zero;
    return content;
}

Value excerptValue(const ExcerptContent& content) {
    std::string commands;
    for (const StampedCommand& command : content.commands) {
        appendNumber(commands, command.time);
        appendNumber(commands, command.command.v);
        appendNumber(commands, command.command.w);
    }
    Value::Table table{{"commands", std::move(commands)}};
    if (content.start) table.emplace("start", Value::Array{content.start->x, content.start->y, content.start->heading});
    return table;
}

std::optional<ExcerptContent> parseExcerpt(const Value& value) {
    const Value* const commands = value.find("commands");
    if (!commands || !commands->asText()) return {};
    ExcerptContent content;
    ByteReader reader(*commands->asText());
    while (!reader.rest().empty()) {
        const auto time = reader.number<Nanoseconds>();
        const auto v = reader.number<double>(), w = reader.number<double>();
        const bool sound =
            std::isfinite(v) && std::isfinite(w) && (content.commands.empty() || time > content.commands.back().time);
        if (reader.failed() || !sound) return {};
        content.commands.push_back({time, {v, w}});
    }
    if (const Value* const start = value.find("start")) {
        const Value::Array* const numbers = start->asArray();
        if (!numbers || numbers->size() != 3) return {};
        double pose[3];
        for (std::size_t i = 0; i < 3; ++i) {
            const double* const number = (*numbers)[i].asFloat();
            if (!number || !std::isfinite(*number)) return {};
            pose[i] = *number;
        }
        content.start = Pose{pose[0], pose[1], pose[2]};
    }
    return content;
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
