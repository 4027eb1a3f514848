#pragma once

#include <memory>
#include <string>

#include "assessment/rollout_requests.h"
#include "scenario/scenario_value.h"

namespace mrose {

/// One rollout of a log world as a scenario that stands by itself: the world's, without the robots that are not in the
/// rollout, with the commands of each of the others from there on, and the state at its start. Made from the value
/// alone it begins as the rollout does, to the last bit, and goes on so: recordings and reports of the rollout need no
/// log. Saved as a file, it plays the log from that instant.
struct OpenedRollout {
    ScenarioValuePointer value;
    std::shared_ptr<const Scenario> scenario;
    WorldState state;
};

/// `world` is what `value` gives where logs are not played. `log` is the place of the log as the rollout names it. The
/// commands last for `duration`, which may be longer than the rollout, the scenario for `length`. Error: no robot has
/// ground truth there; the value is of another world.
Expected<OpenedRollout> openRollout(const LogWorld& world, const ScenarioValue& value, const std::string& log,
                                    const RolloutRequest& rollout, std::uint64_t seed, Nanoseconds length,
                                    Nanoseconds duration);

}  // namespace mrose
