#include "diagnosis/command_jumps.h"

#include <algorithm>

#include "geometry/point.h"
#include "logs/conditioning.h"

namespace mrose {
namespace {

constexpr std::size_t mostJumps = 8;
constexpr double leastJump = 0.1;  // bounds that it is off by after 0.1 s in which it is not obeyed
/// More is not waited for after a gap of commands.
constexpr Nanoseconds longestShown = 600'000'000;

/// How far a robot is off, in bounds, that does not obey it for 0.1 s.
double effectOf(const CommandJump& jump, const DivergenceBound::At& bound) {
    constexpr double late = 0.1;
    return late * length({(jump.command.command.v - jump.before.v) / bound.position,
                          (jump.command.command.w - jump.before.w) / bound.heading});
}

}  // namespace

Nanoseconds commandsShowFor(const MotionModel& model) { return std::min(model.lookBack(), longestShown); }

std::vector<CommandJump> commandJumpsNear(const Trajectory& trajectory, const MotionModel& model,
                                          const ComparedRollout& rollout, Nanoseconds divergence,
                                          const DivergenceBound::At& bound) {
    const std::vector<StampedCommand>& commands = trajectory.commands;
    const Nanoseconds since = rollout.real.start - commandsShowFor(model), end = rollout.real.start + divergence;
    std::vector<CommandJump> jumps;
    auto at = std::upper_bound(commands.begin(), commands.end(), StampedCommand{since, {}}, earlier<StampedCommand>);
    if (at == commands.begin() && at != commands.end()) ++at;
    for (; at != commands.end(); ++at) {
        const CommandJump jump{*at, std::prev(at)->command, commands.back().time};
        if (effectOf(jump, bound) < leastJump) continue;
        if (!jumps.empty()) jumps.back().next = at->time;
        if (at->time >= end) break;
        jumps.push_back(jump);
    }
    while (jumps.size() > mostJumps)
        jumps.erase(std::min_element(jumps.begin(), jumps.end(), [&](const CommandJump& a, const CommandJump& b) {
            return effectOf(a, bound) < effectOf(b, bound);
        }));
    return jumps;
}

}  // namespace mrose
