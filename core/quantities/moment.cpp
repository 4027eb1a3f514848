#include "quantities/moment.h"

namespace mrose {

void noteInsights(const Scenario& scenario, const StepTrace& trace, std::int64_t tick,
                  const std::vector<std::byte>& memoryBefore, std::vector<RobotInsight>& insights) {
    for (std::size_t robot = 0; robot < trace.robots.size(); ++robot) {
        const StepTrace::Robot& of = trace.robots[robot];
        if (!of.decided) continue;
        const auto before = scenario.memoryOf(memoryBefore, robot);
        insights[robot] = {tick - 1,    of.observed,  of.observation,
                           of.decision, of.predicted, {before.begin(), before.end()}};
    }
}

}  // namespace mrose
