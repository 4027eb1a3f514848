#pragma once

#include <functional>
#include <optional>
#include <string>

#include "scenario/scenario.h"
#include "script/lua_sandbox.h"
#include "simulation/step.h"
#include "world/world_state.h"

namespace mrose {

/// Where the real robot is beside which a simulated one of that name drives, at an instant of the run's clock; nothing
/// where nobody knows. Empty: no real log is open.
using RealPoses = std::function<std::optional<Pose>(const std::string& robot, Nanoseconds now)>;

/// What the names of a condition look at: set anew before each evaluation.
struct WorldView {
    const Scenario* scenario = nullptr;
    const WorldState* state = nullptr;
    const StepTrace* trace = nullptr;  ///< of the step that led to `state`; nothing at a run's start
    const RealPoses* real = nullptr;   ///< as if empty: nullptr
};

/// Adds the names of the scenario's bodies and goals and of what can be asked of them (README.md). Their values are
/// read from `view`, which must stay where it is, as long as the sandbox lives. Added
/// again for another scenario, they take the place of the earlier ones.
void addWorldNames(LuaSandbox& sandbox, const Scenario& scenario, const WorldView& view);

}  // namespace mrose
