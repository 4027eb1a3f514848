#include "scenario/first_version.h"

#include <algorithm>

#include "motion/learned_model.h"
#include "sensing/body_sight.h"
#include "sensing/self_localisation.h"
#include "world/first_state_version.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

/// Takes away what motion models without memory had as well.
void layOutMotion(const Scenario& scenario, WorldState& state) {
    std::vector<std::byte> motion;
    for (std::size_t i = 0; i < state.robots.size(); ++i) {
        const std::size_t size = paddedMemory(scenario.scene().modelOf(i).memorySize());
        if (size != 0 && size != firstVersionMotion) return;
        const auto block = std::span(state.motion).subspan(i * firstVersionMotion, size);
        motion.insert(motion.end(), block.begin(), block.end());
    }
    state.motion = std::move(motion);
}

FirstVersionMemory firstVersionMemory(const Scenario& scenario, const WorldState& state, std::size_t robot) {
    FirstVersionMemory then;
    const RobotState& r = state.robots[robot];
    const std::span<const std::byte> motion = scenario.motionMemory(state, robot);
    if (motion.size() == sizeof(LearnedMotion::Memory)) {
        const auto& memory = as<LearnedMotion::Memory>(motion);
        then.unperturbed = memory.unperturbed;
        then.hasUnperturbed = memory.begun != 0;
    } else if (r.nextControl - r.segment.startTick == scenario.periodOf(robot).ticks) {  // it has begun
        then.unperturbed = r.segment.endVelocity;
        then.hasUnperturbed = true;
    }
    const auto& self = as<SelfLocaliser::Memory>(scenario.sensorMemory(state, robot, 0));
    then.bias = self.bias;
    then.self = self.self;
    then.selfMeasured = self.measured;
    then.localised = self.localised != 0;
    then.bearingBias = as<BodySensor::Memory>(scenario.sensorMemory(state, robot, 1)).bearingBias;
    return then;
}

}  // namespace

Expected<WorldState> parseStateOf(const Scenario& scenario, std::string_view bytes, const std::string& name) {
    Expected<WorldState> state = parseState(bytes, name);
    if (state && stateVersion(bytes) == 1 && state->robots.size() == scenario.scene().robots.size())
        layOutMotion(scenario, *state);
    return state;
}

StateHash firstVersionHash(const Scenario& scenario, const WorldState& state) {
    std::vector<FirstVersionMemory> memories;
    for (std::size_t i = 0; i < state.robots.size(); ++i) memories.push_back(firstVersionMemory(scenario, state, i));
    return firstVersionHash(state, memories);
}

}  // namespace mrose
