#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "control/controller.h"
#include "quantities/moment.h"

namespace mrose {

/// The parts of a robot that explain their memory. Each entry is a quantity: robot[1].controller.state, of the part
/// `controller` the entry "state". This is the one place that knows which parts there are: what comes to have a memory
/// of its own is added here, and needs no line in the catalogue.
std::vector<std::string> partNames(const Scenario& scenario, std::size_t robot);

/// What a part, by its place in partNames(), remembers now.
std::vector<MemoryEntry> partEntries(const Moment& moment, std::size_t robot, std::size_t part);

}  // namespace mrose
