#pragma once

#include <span>
#include <vector>

#include "control/sensor_records.h"
#include "world/memory.h"

namespace mrose {

// What conditions, plots and the inspector read of sensors with many elements: always the same entries.

/// `nearest` and its `nearest_bearing`, and how many `echoes` there are. Without any, `nearest` is infinite.
std::vector<MemoryEntry> rangeSummary(std::span<const RangeEcho> echoes);
/// The same, and each element's own: `range_1`, ...; of elements that reported nothing yet, infinite.
std::vector<MemoryEntry> elementSummary(std::span<const RangeEcho> echoes, std::size_t elements);
/// `strongest` and its `strongest_bearing`, and each element's own `intensity_1`, ...
std::vector<MemoryEntry> elementSummary(std::span<const InfraredEcho> echoes, std::size_t elements);

}  // namespace mrose
