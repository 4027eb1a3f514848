#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/step.h"

namespace mrose {

/// What one tick gave otherwise when it was taken again from the same state.
struct RewindDifference {
    std::optional<std::uint32_t> robot;  ///< whose controller hides something; nullopt: it was no controller
    std::string what;                    ///< "its controller decided otherwise: ..."
};

/// One tick taken twice from the same state; `state` and `trace` are as after the first time. A controller that keeps
/// anything outside its memory (a static variable, a clock, a file) is named as soon as that changes its decision or
/// what it remembers. Empty: going back to this tick is exact.
std::vector<RewindDifference> stepTwice(const Scenario& scenario, WorldState& state, StepBuffers& buffers,
                                        StepTrace& trace, const Overrides& overrides = {});

}  // namespace mrose
