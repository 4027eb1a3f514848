#pragma once

#include <memory>

#include "recording/recording.h"
#include "scenario/scenario.h"

namespace mrose {

/// What a branch runs in: all that is constant, and the value that says so.
struct BranchSetup {
    ScenarioValuePointer value;
    std::shared_ptr<const Scenario> scenario;

    const Scene& scene() const { return scenario->scene(); }
};
using BranchSetupPointer = std::shared_ptr<const BranchSetup>;

}  // namespace mrose
