#include "identification/held_out_part.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "io/format.h"

namespace mrose {
namespace {

constexpr double usualBlock = 44, shortestBlock = 20;  // s
constexpr Nanoseconds ever = std::numeric_limits<Nanoseconds>::max();

struct Span {
    Nanoseconds begin = 0, end = 0;
};

/// When it was both commanded and tracked.
Span playedSpan(const Trajectory& trajectory) {
    if (trajectory.commands.empty() || trajectory.poses.empty()) return {};
    return {std::max(trajectory.commands.front().time, trajectory.poses.front().time),
            std::min(trajectory.commands.back().time, trajectory.poses.back().time)};
}

template <class Stamped>
void keepWithin(Nanoseconds begin, Nanoseconds end, std::vector<Stamped>& values) {
    std::erase_if(values, [&](const Stamped& value) { return value.time < begin || value.time > end; });
}

/// What sensors reported between two instants.
void keepWithin(Nanoseconds begin, Nanoseconds end, std::vector<SensorLog>& sensors) {
    for (SensorLog& sensor : sensors) {
        keepWithin(begin, end, sensor.looks);
        keepWithin(begin, end, sensor.poses);
        keepWithin(begin, end, sensor.scans);
    }
}

/// The trajectory between two instants, with the commands from `known` on; the first of them is the one in force then.
Trajectory cut(Trajectory trajectory, Nanoseconds known, const Span& span) {
    const auto later = std::find_if(trajectory.commands.begin(), trajectory.commands.end(),
                                    [&](const StampedCommand& command) { return command.time > known; });
    if (later != trajectory.commands.begin()) std::prev(later)->time = std::max(std::prev(later)->time, known);
    keepWithin(known, span.end, trajectory.commands);
    keepWithin(known, span.end, trajectory.blips);
    keepWithin(known, span.end, trajectory.measuredVelocity);
    keepWithin(known, span.end, trajectory.measuredRotation);
    keepWithin(span.begin, span.end, trajectory.poses);
    keepWithin(span.begin, span.end, trajectory.sensors);
    return trajectory;
}

/// A part of one trajectory of which blocks are held out.
std::vector<Trajectory> piecesOf(const Trajectory& trajectory, const HoldOut& holdOut, LogPart part) {
    const auto blocks = heldOutBlocks(trajectory, holdOut);
    const Nanoseconds guard = fromSeconds(holdOut.guard);
    std::vector<Trajectory> pieces;
    if (part == LogPart::heldOut) {
        for (const auto& [begin, end] : blocks) pieces.push_back(cut(trajectory, -ever, {begin, end - 1}));
        return pieces;
    }
    Nanoseconds known = -ever, begin = -ever;
    const auto add = [&](Nanoseconds end) {
        Trajectory piece = cut(trajectory, known, {begin, end});
        piece.group += static_cast<int>(pieces.size());
        if (piece.poses.size() > 1) pieces.push_back(std::move(piece));
    };
    for (const auto& [blockBegin, blockEnd] : blocks) {
        add(blockBegin - guard);
        known = blockEnd;
        begin = blockEnd + guard;
    }
    add(ever);
    return pieces;
}

/// Drops what a trajectory has of the time of one that is held out and that it continues.
void dropTimeOf(const Trajectory& heldOut, Trajectory& trajectory) {
    const Nanoseconds after = heldOut.poses.back().time + 1;
    keepWithin(after, ever, trajectory.commands);
    keepWithin(after, ever, trajectory.blips);
    keepWithin(after, ever, trajectory.measuredVelocity);
    keepWithin(after, ever, trajectory.measuredRotation);
    keepWithin(after, ever, trajectory.sensors);
}

/// Of a trajectory that is not divided into blocks.
bool isHeldOut(const Trajectory& trajectory, const HoldOut& holdOut) {
    return holdOut.holds(trajectory.group) && heldOutBlocks(trajectory, holdOut).empty();
}

/// What is left of one robot.
std::vector<Trajectory> partOfRobot(std::vector<Trajectory> trajectories, const HoldOut& holdOut, LogPart part) {
    if (part == LogPart::learned)
        for (const Trajectory& other : trajectories)
            for (Trajectory& trajectory : trajectories)
                if (isHeldOut(other, holdOut) && !isHeldOut(trajectory, holdOut) && continues(trajectory, other))
                    dropTimeOf(other, trajectory);
    std::vector<Trajectory> kept;
    for (Trajectory& trajectory : trajectories) {
        if (!heldOutBlocks(trajectory, holdOut).empty())
            for (Trajectory& piece : piecesOf(trajectory, holdOut, part)) kept.push_back(std::move(piece));
        else if (isHeldOut(trajectory, holdOut) == (part == LogPart::heldOut))
            kept.push_back(std::move(trajectory));
    }
    return kept;
}

bool hasBlocks(const Log& log, const HoldOut& holdOut) {
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories)
            if (!heldOutBlocks(trajectory, holdOut).empty()) return true;
    return false;
}

bool hasBothParts(const Log& log, const HoldOut& holdOut) {
    bool heldOut = false, learned = false;
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories) {
            const bool divided = !heldOutBlocks(trajectory, holdOut).empty();
            heldOut = heldOut || divided || isHeldOut(trajectory, holdOut);
            learned = learned || divided || !isHeldOut(trajectory, holdOut);
        }
    return heldOut && learned;
}

Error tooShort(const Log& log, const HoldOut& holdOut, HoldOutBy by) {
    double longest = 0;
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories) {
            const Span span = playedSpan(trajectory);
            longest = std::max(longest, toSeconds(span.end - span.begin));
        }
    const std::string share = "one in " + std::to_string(holdOut.every);
    const std::string times = "a trajectory needs " + std::to_string(std::lround(shortestBlock * holdOut.every)) +
                              " s with commands and ground truth, its longest has " +
                              std::to_string(static_cast<long>(longest)) + " s";
    return {log.source, 0, 0, "",
            by == HoldOutBy::time ? "is too short to hold out " + share + " of its blocks of time: " + times
                                  : "has no group of trajectories to hold out, " + share +
                                        ", and is too short for blocks of time: " + times};
}

}  // namespace

bool continues(const Trajectory& trajectory, const Trajectory& other) {
    if (trajectory.commands.empty() || trajectory.poses.empty() || other.poses.empty()) return false;
    return other.poses.back().time <= trajectory.poses.front().time &&
           other.poses.back().time > trajectory.commands.front().time;
}

std::vector<std::pair<Nanoseconds, Nanoseconds>> heldOutBlocks(const Trajectory& trajectory, const HoldOut& holdOut) {
    std::vector<std::pair<Nanoseconds, Nanoseconds>> blocks;
    if (!holdOut.holdsAny() || !holdOut.byTime()) return blocks;
    const auto [begin, end] = playedSpan(trajectory);
    const double cycles = std::max(1.0, std::round(toSeconds(end - begin) / (holdOut.every * holdOut.block)));
    const auto count = static_cast<Nanoseconds>(cycles) * holdOut.every;
    if (toSeconds(end - begin) < shortestBlock * static_cast<double>(count)) return blocks;
    const auto edge = [&, first = begin, length = end - begin](Nanoseconds i) {
        return first + length / count * i + length % count * i / count;
    };
    for (Nanoseconds i = holdOut.offset; i < count; i += holdOut.every) blocks.emplace_back(edge(i), edge(i + 1));
    return blocks;
}

Expected<Log> partOf(Log log, const HoldOut& holdOut, LogPart part) {
    bool any = false;
    for (RobotLog& robot : log.robots) {
        robot.trajectories = partOfRobot(std::move(robot.trajectories), holdOut, part);
        any = any || !robot.trajectories.empty();
    }
    if (any) return log;
    const std::string what = holdOut.byTime() ? "block of time" : "group of trajectories";
    return fail(log.source, "has no " + what + " to " +
                                (part == LogPart::heldOut ? "hold out" : "learn from besides those held out"));
}

Expected<HoldOut> holdOutOf(std::span<const Log> logs, double share, int part, HoldOutBy by) {
    if (share <= 0) return HoldOut{};
    const int every = std::max(2, static_cast<int>(std::lround(1 / share)));
    const int offset = (part % every + every - 1) % every;
    const HoldOut groups{every, offset}, time{every, offset, usualBlock};
    if (by != HoldOutBy::time) {
        const auto both = [&](const Log& log) { return hasBothParts(log, groups); };
        if (std::all_of(logs.begin(), logs.end(), both)) return groups;
    }
    if (by == HoldOutBy::groups)
        for (const Log& log : logs)
            for (const LogPart wanted : {LogPart::heldOut, LogPart::learned})
                if (const auto kept = partOf(log, groups, wanted); !kept) return tl::unexpected(kept.error());
    for (const Log& log : logs)
        if (!hasBothParts(log, time) || (by == HoldOutBy::time && !hasBlocks(log, time)))
            return tl::unexpected(tooShort(log, time, by));
    return time;
}

std::string keptFromLearning(const HoldOut& part) {
    if (!part.holdsAny()) return {};
    const std::string every = "one in " + std::to_string(part.every);
    if (!part.byTime()) return every + " of the groups of trajectories";
    return every + " of the blocks of about " + fixed(part.block, 0) + " s; nor was learned from " +
           fixed(part.guard, 1) + " s before and after each";
}

}  // namespace mrose
