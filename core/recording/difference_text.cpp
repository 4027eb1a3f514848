#include "recording/difference_text.h"

namespace mrose {
namespace {

using Part = StateDifference::Part;

std::string named(const char* kind, std::size_t index, const std::string& name) {
    return kind + (' ' + std::to_string(index + 1)) + (name.empty() ? "" : " (" + name + ')');
}

std::string bodyText(const Scenario& scenario, std::size_t body) {
    const Scene& scene = scenario.scene();
    if (body < scene.robots.size()) return robotText(scenario, body);
    const std::size_t object = body - scene.robots.size();
    return named("object", object, scene.objects[object].name);
}

/// "command 3 of robot 2", where there is one whose command it is.
std::string commandText(const Scenario& scenario, const WorldState& state, std::size_t index) {
    for (std::size_t i = 0; i < state.robots.size(); ++i) {
        const std::span<const StampedCommand> slots = scenario.commandSlots(state, i);
        const auto first = static_cast<std::size_t>(slots.data() - state.commands.data());
        if (index >= first && index < first + slots.size())
            return "command " + std::to_string(index - first + 1) + " of " + robotText(scenario, i);
    }
    return "command " + std::to_string(index + 1);
}

/// "controller memory of robot 2, byte 3", where there is one of these bodies whose memory it is; `blockOf` gives a
/// body's in `all`.
template <class BlockOf>
std::string memoryText(const Scenario& scenario, const std::vector<std::byte>& all, std::size_t index,
                       const char* whose, BlockOf blockOf, std::size_t bodies) {
    for (std::size_t i = 0; i < bodies; ++i) {
        const std::span<const std::byte> memory = blockOf(i);
        const auto first = static_cast<std::size_t>(memory.data() - all.data());
        if (index >= first && index < first + memory.size())
            return std::string(whose) + " memory of " + bodyText(scenario, i) + ", byte " +
                   std::to_string(index - first);
    }
    return std::string(whose) + " memory, byte " + std::to_string(index);
}

std::string placeText(const Scenario& scenario, const WorldState& state, const StateDifference& difference) {
    switch (difference.part) {
        case Part::state:
            return "";
        case Part::robot:
            return robotText(scenario, difference.index);
        case Part::object:
            return bodyText(scenario, state.robots.size() + difference.index);
        case Part::contact:
            return named("contact", difference.index, "");
        case Part::kick:
            return named("kick", difference.index, "");
        case Part::message:
            return named("message", difference.index, "");
        case Part::goal:
            return named("goal", difference.index, scenario.scene().environment.goals[difference.index].name);
        case Part::command:
            return commandText(scenario, state, difference.index);
        case Part::motion:
            return memoryText(
                scenario, state.motion, difference.index, "motion model",
                [&](std::size_t body) { return scenario.motionMemory(state, body); }, scenario.scene().bodyCount());
        case Part::memory:
            return memoryText(
                scenario, state.memory, difference.index, "controller",
                [&](std::size_t robot) { return scenario.memoryOf(state, robot); }, state.robots.size());
        case Part::sensing:
            return memoryText(
                scenario, state.sensing, difference.index, "sensor",
                [&](std::size_t robot) { return scenario.sensorMemory(state, robot); }, state.robots.size());
        case Part::past:
            return "past pose of " + bodyText(scenario, difference.index % scenario.scene().bodyCount());
        case Part::touch:
            return named("touch", difference.index, "");
    }
    return "";
}

}  // namespace

std::string robotText(const Scenario& scenario, std::size_t robot) {
    const Scene& scene = scenario.scene();
    const bool person = scene.typeOf(robot).person;
    std::size_t before = 0;
    for (std::size_t i = 0; i < robot; ++i) before += scene.typeOf(i).person == person ? 1 : 0;
    return named(person ? "person" : "robot", before, scene.robots[robot].name);
}

std::string differenceText(const Scenario& scenario, const WorldState& state, const StateDifference& difference) {
    std::string text = placeText(scenario, state, difference);
    if (!text.empty() && !difference.field.empty()) text += ' ';
    return text + difference.field + ": recorded " + difference.first + ", now " + difference.second;
}

}  // namespace mrose
