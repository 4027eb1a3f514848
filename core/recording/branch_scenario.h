#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "recording/kept_texts.h"
#include "recording/recording.h"

namespace mrose {

/// The scenario of the run, or of a branch that has its own, as it lies in a recording, compressed, and back; README.md
/// of this folder has the layout.
struct BranchScenario {
    std::uint32_t branch = 0;  ///< 0: the run
    Recording::Layout layout;
    ScenarioValuePointer value;
};
/// `run`: the run's, of whose files the branch's need not be repeated; null for the run itself.
std::string branchScenarioBytes(const BranchScenario& scenario, const ScenarioValue* run);

/// nullopt where the bytes are none, or name a file that the run does not have. `texts`: the run's in an old recording.
std::optional<BranchScenario> parseBranchScenario(std::string_view bytes, const ScenarioValue* run,
                                                  const KeptTexts& texts = {});

}  // namespace mrose
