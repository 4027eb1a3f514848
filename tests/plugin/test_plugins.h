#pragma once

#include <string>
#include <vector>

#include "plugin/isolated_controller.h"
#include "simulation/small_world.h"

namespace mrose {

/// The path of one of the plug-ins in tests/plugin/plugins.
std::string testPlugin(const std::string& name);

/// Options of the misbehaving one.
std::string how(const std::string& what, double after = 0);

/// The program mrose serves isolated plug-ins.
IsolationOptions isolation(double limit = 60);

/// Robots driven by these controllers, each with a kicker, and a ball.
Scenario drivenBy(std::vector<std::shared_ptr<const Controller>> controllers);

/// What the steps of a run reported as faults, in order.
std::vector<StepTrace::Fault> faultsOfRun(const Scenario& scenario, WorldState& state, int ticks);

}  // namespace mrose
