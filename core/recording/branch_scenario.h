#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "recording/recording.h"

namespace mrose {

/// A branch's own scenario as it lies in a recording, compressed, and back; README.md of this folder tells the layout.
/// Texts that are the same as those of the run are told by their names.
struct BranchScenario {
    std::uint32_t branch = 0;
    Recording::Layout layout;
    Descriptions descriptions;
};
std::string branchScenarioBytes(const BranchScenario& scenario, const Descriptions& run);

/// Nothing where the bytes are none, or name a text that the run does not have.
std::optional<BranchScenario> parseBranchScenario(std::string_view bytes, const Descriptions& run);

}  // namespace mrose
