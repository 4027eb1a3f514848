#include "debug/dead_time_queue.h"

#include <algorithm>

namespace mrose {

DeadTimeQueue deadTimeQueueOf(const Scenario& scenario, const WorldState& state, std::size_t robot) {
    const CommandView view = scenario.commandsOf(state, robot);
    const Scene& scene = scenario.scene();
    DeadTimeQueue queue{{}, view.beforeFirst(), scene.timeOf(state.tick), scene.modelOf(robot).deadTimes()};
    for (std::size_t i = 0; i < view.size(); ++i) queue.commands.push_back({view.issueTime(i), view.command(i)});
    queue.period = scene.modelOf(robot).period();
    queue.lastInstant = scene.timeOf(state.robots[robot].nextControl) - queue.period;
    return queue;
}

CommandsOnTheWay commandsOnTheWay(const DeadTimeQueue& queue) {
    CommandsOnTheWay way{queue.before, {}};
    for (const StampedCommand& issued : queue.commands) {
        const Nanoseconds untilV = std::max<Nanoseconds>(0, issued.time + queue.deadTimes.v - queue.now);
        const Nanoseconds untilW = std::max<Nanoseconds>(0, issued.time + queue.deadTimes.w - queue.now);
        if (untilV == 0) way.active.v = issued.command.v;
        if (untilW == 0) way.active.w = issued.command.w;
        if (untilV > 0 || untilW > 0) way.coming.push_back({issued, untilV, untilW});
    }
    return way;
}

}  // namespace mrose
