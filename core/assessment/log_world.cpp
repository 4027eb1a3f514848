#include "assessment/log_world.h"

#include <algorithm>
#include <limits>

#include "assessment/windows.h"
#include "behaviour/command_player.h"
#include "io/format.h"
#include "scenario/log_excerpt.h"

namespace mrose {
namespace {

using Names = std::vector<std::string>;

bool holds(const Names& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// What stays where the robots marked are taken out; the indices of those that are left.
std::vector<std::size_t> removeRobots(ScenarioParts& parts, const std::vector<bool>& removed) {
    std::vector<std::size_t> newIndex(removed.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < removed.size(); ++i) {
        newIndex[i] = kept;
        if (removed[i]) continue;
        const auto place = static_cast<std::uint32_t>(parts.scene.placeOf(i));
        parts.scene.robots[kept] = parts.scene.robots[i];
        if (place != kept) parts.scene.robots[kept].place = place;
        parts.controllers[kept++] = parts.controllers[i];
    }
    parts.scene.robots.resize(kept);
    parts.controllers.resize(kept);
    std::erase_if(parts.players, [&](const LogPlayer& player) { return removed[player.robot]; });
    for (LogPlayer& player : parts.players) player.robot = static_cast<std::uint32_t>(newIndex[player.robot]);
    return newIndex;
}

std::size_t indexOf(const Log& log, const std::string& robot) {
    const auto found =
        std::find_if(log.robots.begin(), log.robots.end(), [&](const RobotLog& r) { return r.robot == robot; });
    return static_cast<std::size_t>(found - log.robots.begin());
}

/// "1,2": those of the log that are played, for a hint.
std::string playedNames(const Log& log, const ScenarioParts& parts) {
    Names names;
    for (const LogPlayer& player : parts.players)
        if (indexOf(log, player.excerpt.robot) < log.robots.size() && !holds(names, player.excerpt.robot))
            names.push_back(player.excerpt.robot);
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
    return text;
}

std::optional<std::size_t> trajectoryNamed(const RobotLog& robot, const std::string& name) {
    for (std::size_t i = 0; i < robot.trajectories.size(); ++i)
        if (robot.trajectories[i].name == name) return i;
    return std::nullopt;
}

std::string noCommands(const RobotLog& robot) {
    return "has no commands of robot \"" + robot.robot +
           "\"; expected the commands that it was sent and the poses that it reached";
}

}  // namespace

Expected<void> checkComparable(const Log& log, const RobotLog& robot, const Trajectory& trajectory) {
    if (trajectory.commands.empty()) return fail(log.source, noCommands(robot));
    if (trajectory.poses.empty())
        return fail(log.source, "has no ground truth of robot \"" + robot.robot +
                                    "\": nothing to compare with; expected its poses (x, y, heading) beside its "
                                    "commands");
    if (auto overlap = checkOverlap(robot.robot, trajectory); !overlap) return fail(log.source, overlap.error().cause);
    return {};
}

Expected<LogWorld> LogWorld::create(ScenarioParts parts, std::shared_ptr<const Log> log, const Names& robots) {
    LogWorld world(std::move(parts), std::move(log));
    if (const auto found = world.findRobots(robots); !found) return tl::unexpected(found.error());
    if (const auto found = world.findSessions(); !found) return tl::unexpected(found.error());
    world.gatherAll();
    for (std::size_t session = 0; session < world.sessions_.size(); ++session) {
        std::vector<TrackerHistory>& tracked = world.tracked_.emplace_back();
        for (std::size_t i = 0; i < world.robots_.size(); ++i)
            tracked.emplace_back(world.trajectory(session, i), world.parts_.scene.modelOf(world.robots_[i].body));
    }
    return world;
}

Expected<void> LogWorld::findRobots(const Names& chosen) {
    if (parts_.players.empty())
        return fail({}, "plays no log; expected a robot with controller = { kind = \"log_player\", ... }");
    for (const std::string& name : chosen) {
        if (indexOf(*log_, name) == log_->robots.size()) return fail(log_->source, "has no robot \"" + name + '"');
        if (std::none_of(parts_.players.begin(), parts_.players.end(),
                         [&](const LogPlayer& player) { return player.excerpt.robot == name; }))
            return fail({}, "has no robot that plays robot \"" + name + "\" of a log", 0, "--robots");
    }
    removeRobots(parts_, removedOf(chosen));
    for (const LogPlayer& player : parts_.players) {
        const std::string& name = parts_.scene.robots[player.robot].name;
        const std::size_t real = indexOf(*log_, player.excerpt.robot);
        if (real == log_->robots.size()) {
            const std::string present = playedNames(*log_, parts_);
            return fail(log_->source, "has no robot \"" + player.excerpt.robot + "\", which \"" + name + "\" plays" +
                                          (present.empty() ? "; expected a log of the scenario's robots"
                                                           : "; --robots " + present + " compares those that it has"));
        }
        robots_.push_back({player.robot, name, real, player.excerpt.robot});
        excerpts_.push_back(player.excerpt);
    }
    return {};
}

/// By body: who is not compared. Where nothing could be, all stay, so that it is said why.
std::vector<bool> LogWorld::removedOf(const Names& chosen) {
    std::vector<bool> removed(parts_.scene.robots.size());
    if (!chosen.empty()) {
        for (const LogPlayer& player : parts_.players) removed[player.robot] = !holds(chosen, player.excerpt.robot);
        return removed;
    }
    const auto lacks = [&](const LogPlayer& player) {
        const std::size_t real = indexOf(*log_, player.excerpt.robot);
        return real < log_->robots.size() && !hasBothSides(log_->robots[real]);
    };
    if (std::all_of(parts_.players.begin(), parts_.players.end(), lacks)) return removed;
    for (const LogPlayer& player : parts_.players) {
        removed[player.robot] = lacks(player);
        if (!removed[player.robot]) continue;
        const RobotLog& real = log_->robots[indexOf(*log_, player.excerpt.robot)];
        leftOut_.push_back("Robot \"" + real.robot + "\" is not compared: the log has no " + missingSide(real) +
                           " of it.");
    }
    return removed;
}

/// Where no trajectory is named, a robot's only one, or those of one name of all the robots that have several.
Expected<void> LogWorld::findSessions() {
    std::vector<std::size_t> trajectories(robots_.size()), open;
    for (std::size_t i = 0; i < robots_.size(); ++i) {
        const RobotLog& real = log_->robots[robots_[i].real];
        const std::string& named = excerpts_[i].trajectory;
        if (named.empty()) {
            if (real.trajectories.size() > 1) open.push_back(i);
        } else if (const auto found = trajectoryNamed(real, named)) {
            trajectories[i] = *found;
        } else {
            return fail(log_->source, "has no trajectory \"" + named + "\" of robot \"" + real.robot + '"');
        }
    }
    const std::size_t count = open.empty() ? 1 : log_->robots[robots_[open.front()].real].trajectories.size();
    for (std::size_t k = 0; k < count; ++k) {
        std::string name;
        bool complete = true;
        for (const std::size_t i : open) {
            if (name.empty()) name = log_->robots[robots_[i].real].trajectories[k].name;
            const auto found = trajectoryNamed(log_->robots[robots_[i].real], name);
            complete = complete && found;
            trajectories[i] = found.value_or(0);
        }
        if (!complete) continue;
        auto session = sessionOf(trajectories, k == 0);
        if (!session) return tl::unexpected(session.error());
        session->name = std::move(name);
        sessions_.push_back(std::move(*session));
    }
    if (sessions_.empty())
        return fail(log_->source,
                    "has no trajectory that all robots of the scenario have; expected one to be named beside each log");
    return {};
}

Expected<LogSession> LogWorld::sessionOf(const std::vector<std::size_t>& trajectories, bool first) const {
    LogSession session;
    Nanoseconds common = std::numeric_limits<Nanoseconds>::min();
    for (std::size_t i = 0; i < robots_.size(); ++i) {
        const RobotLog& real = log_->robots[robots_[i].real];
        if (real.trajectories.empty()) return fail(log_->source, noCommands(real));
        const Trajectory& trajectory = real.trajectories[trajectories[i]];
        if (auto comparable = checkComparable(*log_, real, trajectory); !comparable)
            return tl::unexpected(comparable.error());
        common = std::max(common, beginning(trajectory));
    }
    // As an excerpt begins: when all robots of the log are there, whether they are compared or not.
    if (first)
        for (const RobotLog& robot : log_->robots)
            if (!robot.trajectories.empty()) common = std::max(common, beginning(robot.trajectories.front()));
    for (std::size_t i = 0; i < robots_.size(); ++i) {
        const Trajectory& trajectory = log_->robots[robots_[i].real].trajectories[trajectories[i]];
        const LogExcerpt& excerpt = excerpts_[i];
        const Nanoseconds begin = excerpt.trajectory.empty() ? common : beginning(trajectory);
        session.parts.push_back({trajectories[i], begin + fromSeconds(excerpt.start)});
        session.length = std::max(session.length, trajectory.poses.back().time - session.parts.back().origin);
    }
    return session;
}

void LogWorld::play(ScenarioParts& parts, std::size_t body, const RolloutStart& start, Nanoseconds duration,
                    Attention reads) {
    std::vector<StampedCommand> commands = commandsRead(start, start.time + duration);
    for (StampedCommand& command : commands) command.time -= start.time;
    RolloutStart now = start;
    fillVelocities(parts.scene.modelOf(body), {&now, 1});
    SceneRobot& robot = parts.scene.robots[body];
    robot.start = start.pose;
    robot.velocity = now.velocity->velocity;
    robot.tracked = start.tracked;
    robot.sent = commands;
    std::erase_if(robot.sent, [](const StampedCommand& command) { return command.time > 0; });
    robot.phase = 0;
    parts.controllers[body] = std::make_shared<const CommandPlayer>(commands, std::move(reads));
}

void LogWorld::gatherAll() {
    ScenarioParts parts = parts_;
    const auto idle = std::make_shared<const CommandPlayer>(std::vector<StampedCommand>{});
    for (const ComparedRobot& robot : robots_) parts.controllers[robot.body] = idle;
    allRobots_ = std::make_shared<const Scenario>(std::move(parts));
}

LogWorld::OpenedParts LogWorld::partsAt(std::size_t session, Nanoseconds start, Nanoseconds duration) const {
    OpenedParts opened;
    ScenarioParts& parts = opened.parts = parts_;
    std::vector<bool> removed(parts.scene.robots.size());
    for (std::size_t i = 0; i < robots_.size(); ++i) {
        const std::size_t body = robots_[i].body;
        const Nanoseconds now = sessions_[session].parts[i].origin + start;
        auto measured = measureStart(trajectory(session, i), now, 0);
        if (measured) measured->tracked = tracked_[session][i].at(now);
        removed[body] = !measured;
        opened.starts.push_back(measured ? std::optional(*measured) : std::nullopt);
        if (!measured) continue;
        play(parts, body, *measured, duration, parts.controllers[body]->attention());
    }
    const std::vector<std::size_t> bodies = removeRobots(parts, removed);
    for (const ComparedRobot& robot : robots_) opened.bodies.push_back(bodies[robot.body]);
    return opened;
}

LogWorld::Opened LogWorld::openAt(std::size_t session, Nanoseconds start, Nanoseconds duration,
                                  std::uint64_t seed) const {
    OpenedParts made = partsAt(session, start, duration);
    Opened opened;
    opened.starts = std::move(made.starts);
    opened.bodies = std::move(made.bodies);
    opened.scenario = std::make_shared<const Scenario>(std::move(made.parts));
    opened.state = opened.scenario->initialState(seed);
    return opened;
}

}  // namespace mrose
