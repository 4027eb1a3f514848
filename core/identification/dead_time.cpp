#include "identification/dead_time.h"

#include "identification/response_fit.h"
#include "learning/parallel_for.h"

namespace mrose {
namespace {

constexpr std::int64_t fewestSwitches = 5;
constexpr double largestError = 0.1;  // s
constexpr double leastExplained = 0.05;

bool hasTruth(std::span<const RobotLog> robots) {
    for (const RobotLog& robot : robots)
        for (const Trajectory& trajectory : robot.trajectories)
            if (!trajectory.poses.empty()) return true;
    return false;
}

ChannelDelay unidentified(ChannelDelay delay, std::string reason) {
    delay.reason = std::move(reason);
    return delay;
}

ChannelDelay identify(std::span<const RobotLog> robots, Channel channel) {
    DelayedResponse response(channel, StaticMap::bent);
    for (const RobotLog& robot : robots)
        for (const Trajectory& trajectory : robot.trajectories) response.add(trajectory);
    ChannelDelay delay;
    delay.switches = response.switches();
    delay.windows = response.windows();
    if (!hasTruth(robots)) return unidentified(delay, "no ground truth");
    if (delay.windows < fewestWindows) return unidentified(delay, "too little ground truth beside commands");
    if (delay.switches < fewestSwitches)
        return unidentified(delay, "the command changes only " + std::to_string(delay.switches) + " times");
    const ResponseFit fit = fitResponse(std::move(response));
    delay.deadTime = fit.kernel.deadTime;
    delay.deadTimeError = fit.standardError.deadTime;
    delay.lag = fit.kernel.lag;
    delay.lagError = fit.standardError.lag;
    delay.jitter = fit.jitter;
    delay.jitterError = fit.jitterError;
    delay.explained = fit.explained;
    delay.droppedWindows = fit.dropped;
    if (!(fit.explained > leastExplained)) return unidentified(delay, "the motion does not follow the command");
    if (!(delay.deadTimeError < largestError)) return unidentified(delay, "the standard error exceeds 0.1 s");
    delay.identified = true;
    return delay;
}

}  // namespace

std::string ChannelDelay::quality() const {
    if (!identified) return "not identifiable: " + reason;
    if (deadTimeError <= 0.01 && explained >= 0.75) return "good";
    return deadTimeError <= 0.03 && explained >= 0.5 ? "fair" : "poor";
}

DeadTimes identifyDeadTimes(std::span<const RobotLog> robots) {
    return {identify(robots, Channel::v), identify(robots, Channel::w)};
}

std::vector<DeadTimes> identifyEachDeadTime(const Log& log) {
    std::vector<DeadTimes> result(log.robots.size());
    parallelFor(2 * result.size(), [&](std::size_t task) {
        const std::span<const RobotLog> robot(&log.robots[task / 2], 1);
        if (task % 2 == 0)
            result[task / 2].v = identify(robot, Channel::v);
        else
            result[task / 2].w = identify(robot, Channel::w);
    });
    return result;
}

}  // namespace mrose
