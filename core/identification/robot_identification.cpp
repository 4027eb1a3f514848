#include "identification/robot_identification.h"

#include <algorithm>

#include "identification/dead_time.h"
#include "identification/kinematic_fit.h"
#include "learning/parallel_for.h"

namespace mrose {
namespace {

/// The logs of one robot, pooled.
struct Pooled {
    std::string robot, source;
    std::vector<RobotLog> logs;
};

std::vector<Pooled> poolByName(std::span<const Log> logs) {
    std::vector<Pooled> pools;
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots) {
            auto pool =
                std::find_if(pools.begin(), pools.end(), [&](const Pooled& p) { return p.robot == robot.robot; });
            if (pool == pools.end()) pool = pools.insert(pools.end(), {robot.robot, log.source, {}});
            pool->logs.push_back(robot);
        }
    return pools;
}

MotionNetwork::Identified::Delay delayOf(const ChannelDelay& channel) {
    if (!channel.identified) return {};
    return {channel.deadTime, channel.deadTimeError, channel.lag, channel.jitter};
}

Expected<MotionNetwork::Identified> identify(const Pooled& pool) {
    const auto delayed = fitKinematics(pool.logs, KinematicFit::deadTime, pool.source);
    if (!delayed) return tl::unexpected(delayed.error());
    const auto dynamic = fitKinematics(pool.logs, KinematicFit::dynamic, pool.source);
    if (!dynamic) return tl::unexpected(dynamic.error());
    const DeadTimes times = identifyDeadTimes(pool.logs);
    return MotionNetwork::Identified{pool.robot, {}, delayOf(times.v), delayOf(times.w), *delayed, *dynamic};
}

}  // namespace

Expected<std::vector<MotionNetwork::Identified>> identifyRobots(std::span<const Log> logs) {
    const std::vector<Pooled> pools = poolByName(logs);
    std::vector<Expected<MotionNetwork::Identified>> results(pools.size());
    parallelFor(pools.size(), [&](std::size_t i) { results[i] = identify(pools[i]); });
    std::vector<MotionNetwork::Identified> identified;
    for (auto& result : results) {
        if (!result) return tl::unexpected(result.error());
        identified.push_back(std::move(*result));
    }
    return identified;
}

}  // namespace mrose
