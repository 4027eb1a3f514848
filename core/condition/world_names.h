#pragma once

#include "scenario/scenario.h"
#include "script/lua_sandbox.h"
#include "simulation/step.h"
#include "world/world_state.h"

namespace mrose {

/// What the names of a condition look at: set anew before each evaluation.
struct WorldView {
    const Scenario* scenario = nullptr;
    const WorldState* state = nullptr;
    const StepTrace* trace = nullptr;  ///< of the step that led to `state`; nothing at a run's start
};

/// Adds the names of the scenario's bodies and goals and of what can be asked of them (README.md). Their values are
/// read from `view`, which must stay where it is, as long as the sandbox lives. Added
/// again for another scenario, they take the place of the earlier ones.
void addWorldNames(LuaSandbox& sandbox, const Scenario& scenario, const WorldView& view);

}  // namespace mrose
