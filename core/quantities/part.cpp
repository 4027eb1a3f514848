#include "quantities/part.h"

namespace mrose {

std::vector<std::string> partNames(const Scenario& /*scenario*/, std::size_t /*robot*/) { return {"controller"}; }

std::vector<MemoryEntry> partEntries(const Moment& moment, std::size_t robot, std::size_t /*part*/) {
    return moment.scenario->controller(robot).explain(moment.scenario->memoryOf(*moment.state, robot));
}

}  // namespace mrose
