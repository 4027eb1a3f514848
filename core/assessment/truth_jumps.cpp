#include "assessment/truth_jumps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/point.h"
#include "geometry/pose.h"
#include "logs/conditioning.h"

namespace mrose {
namespace {

constexpr Nanoseconds commandedBefore = 2 * nanosecondsPerSecond;
constexpr double timesCommanded = 2, leastDistance = 0.1, leastTurn = 0.3;  // m, rad
// Of headings that turn at once.
constexpr std::size_t aside = 5;                                 // poses on either side
constexpr double leastStep = 0.012, usualAtFirst = 0.001;        // rad
constexpr double timesUsual = 10, mostUsual = 3, usualOf = 200;  // poses

/// The largest speeds commanded between two instants, with the command in force at the first one.
Command fastestCommanded(const std::vector<StampedCommand>& commands, Nanoseconds from, Nanoseconds to) {
    auto at = std::upper_bound(commands.begin(), commands.end(), StampedCommand{from, {}}, earlier<StampedCommand>);
    if (at != commands.begin()) --at;
    Command fastest;
    for (; at != commands.end() && at->time <= to; ++at) {
        fastest.v = std::max(fastest.v, std::abs(at->command.v));
        fastest.w = std::max(fastest.w, std::abs(at->command.w));
    }
    return fastest;
}

}  // namespace

std::vector<TruthJump> truthJumps(const Trajectory& trajectory, Nanoseconds from, Nanoseconds to) {
    std::vector<TruthJump> jumps;
    if (trajectory.commands.empty()) return jumps;
    const std::vector<StampedPose>& poses = trajectory.poses;
    auto at = std::upper_bound(poses.begin(), poses.end(), StampedPose{from, {}}, earlier<StampedPose>);
    if (at == poses.begin() && at != poses.end()) ++at;
    if (at == poses.end()) return jumps;
    auto known = std::prev(at);
    while (known != poses.begin() && std::prev(known)->pose == known->pose) --known;
    Nanoseconds since = known->time;
    for (; at != poses.end() && at->time <= to; ++at) {
        const Pose &before = std::prev(at)->pose, &after = at->pose;
        if (after == before) continue;
        const TruthJump jump{std::prev(at)->time, at->time, distance(position(before), position(after)),
                             std::abs(wrapAngle(after.heading - before.heading))};
        const double passed = toSeconds(at->time - since);
        const Command commanded = fastestCommanded(trajectory.commands, at->time - commandedBefore, at->time);
        if (jump.distance > timesCommanded * commanded.v * passed + leastDistance ||
            jump.turn > timesCommanded * commanded.w * passed + leastTurn)
            jumps.push_back(jump);
        since = at->time;
    }
    return jumps;
}

std::vector<HeadingStep> headingSteps(const Trajectory& trajectory) {
    std::vector<StampedPose> poses;
    for (const StampedPose& stamped : trajectory.poses)
        if (poses.empty() || !(stamped.pose == poses.back().pose)) poses.push_back(stamped);
    std::vector<HeadingStep> steps;
    double usual = usualAtFirst;
    for (std::size_t i = aside; i + aside + 1 < poses.size(); ++i) {
        const Nanoseconds known = poses[i + 1 + aside].time;
        if (known - poses[i - aside].time > nanosecondsPerSecond / 2) continue;
        std::array<double, 2 * aside + 1> turns;
        for (std::size_t k = 0; k < turns.size(); ++k) {
            const StampedPose* const pose = &poses[i - aside + k];
            turns[k] = wrapAngle(pose[1].pose.heading - pose[0].pose.heading);
        }
        const double turn = turns[aside];
        std::nth_element(turns.begin(), turns.begin() + aside, turns.end());
        const double more = std::abs(turn - turns[aside]);
        if (more > std::max(leastStep, timesUsual * usual)) steps.push_back({poses[i + 1].time, known});
        usual += (std::min(more, mostUsual * usual) - usual) / usualOf;
    }
    return steps;
}

}  // namespace mrose
