#include "quantities/part.h"

namespace mrose {

std::vector<std::string> partNames(const Scenario& scenario, std::size_t robot) {
    std::vector<std::string> names{"controller", "motion"};
    for (const SensorPointer& sensor : scenario.sensors(robot)) names.push_back(sensor->name());
    return names;
}

std::vector<MemoryEntry> partEntries(const Moment& moment, std::size_t robot, std::size_t part) {
    const Scenario& scenario = *moment.scenario;
    if (part == 0) return scenario.controller(robot).explain(scenario.memoryOf(*moment.state, robot));
    if (part == 1) return scenario.scene().modelOf(robot).explain(scenario.motionMemory(*moment.state, robot));
    return scenario.sensors(robot)[part - 2]->explain(scenario.sensorMemory(*moment.state, robot, part - 2));
}

}  // namespace mrose
