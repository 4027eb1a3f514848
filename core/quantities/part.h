#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/controller.h"
#include "quantities/moment.h"

namespace mrose {

/// The parts of a body that explain their memory: of a robot its controller, its motion model and its sensors, of an
/// object its motion model. Each entry is a quantity: robot[1].controller.state, of the part `controller` the entry
/// "state". This is the one place that knows which parts there are: what comes to have a memory of its own is added
/// here, and needs no line in the catalogue.
std::vector<std::string> partNames(const Scenario& scenario, std::size_t body);

/// The place of the one of that name; nothing: there is none.
std::optional<std::size_t> partNamed(const Scenario& scenario, std::size_t body, std::string_view name);
/// Whether the one at a place has that name: where bodies may be of other types than before.
bool isPartNamed(const Scenario& scenario, std::size_t body, std::size_t part, std::string_view name);

/// The place of a robot's first sensor among its parts; those before explain what the state holds alone.
constexpr std::size_t firstSensorPart = 2;

/// What a part, by its place in partNames(), remembers now; of a sensor also what it reported at the last control
/// instant: the numbers of its newest reading where that has one record and the sensor's name, of others how many
/// records there are.
std::vector<MemoryEntry> partEntries(const Moment& moment, std::size_t body, std::size_t part);
/// The same, as far as it is wanted.
void addPartEntries(const Moment& moment, std::size_t body, std::size_t part, MemoryEntries& entries);

/// All entries that it can have, by their names and units alone, where they are known; of controllers and motion models
/// they are not.
std::vector<MemoryEntry> knownEntries(const Moment& moment, std::size_t body, std::size_t part);

}  // namespace mrose
