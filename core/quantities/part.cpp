#include "quantities/part.h"

namespace mrose {

std::vector<std::string> partNames(const Scenario& /*scenario*/, std::size_t /*robot*/) {
    return {"controller", "motion"};
}

std::vector<MemoryEntry> partEntries(const Moment& moment, std::size_t robot, std::size_t part) {
    const Scenario& scenario = *moment.scenario;
    if (part == 0) return scenario.controller(robot).explain(scenario.memoryOf(*moment.state, robot));
    return scenario.scene().modelOf(robot).explain(scenario.motionMemory(*moment.state, robot));
}

}  // namespace mrose
