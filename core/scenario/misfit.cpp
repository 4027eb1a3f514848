#include "scenario/misfit.h"

#include <cmath>

#include "world/state_fields.h"

namespace mrose {
namespace {

template <class T>
bool finite(const T& value) {
    bool all = true;
    visitNumbers(value, [&](const auto& number) {
        if constexpr (std::is_floating_point_v<std::remove_cvref_t<decltype(number)>>)
            all = all && std::isfinite(number);
    });
    return all;
}

template <class T>
bool allFinite(const std::vector<T>& values) {
    for (const T& value : values)
        if (!finite(value)) return false;
    return true;
}

std::string wrongSize(const char* what, std::size_t found, std::size_t expected) {
    if (found == expected) return {};
    return std::to_string(found) + ' ' + what + "; the scenario has " + std::to_string(expected);
}

std::string wrongSizes(const Scenario& scenario, const WorldState& state) {
    const WorldState own = scenario.freshState(0);
    for (std::string wrong : {wrongSize("robots", state.robots.size(), own.robots.size()),
                              wrongSize("objects", state.objects.size(), own.objects.size()),
                              wrongSize("goals", state.goals.size(), own.goals.size()),
                              wrongSize("places for commands", state.commands.size(), own.commands.size()),
                              wrongSize("bytes of controllers' memory", state.memory.size(), own.memory.size()),
                              wrongSize("past poses", state.past.size(), own.past.size())})
        if (!wrong.empty()) return wrong;
    return {};
}

bool soundCommands(const Scenario& scenario, const WorldState& state, std::size_t robot) {
    const std::span<const StampedCommand> slots = scenario.commandSlots(state, robot);
    const std::size_t count = state.robots[robot].commandCount;
    if (count > slots.size()) return false;
    for (std::size_t i = 1; i < count; ++i)
        if (slots[i].time < slots[i - 1].time) return false;
    return true;
}

}  // namespace

std::string misfit(const Scenario& scenario, const WorldState& state) {
    if (std::string wrong = wrongSizes(scenario, state); !wrong.empty()) return wrong;
    const std::size_t bodies = scenario.scene().bodyCount();
    for (std::size_t i = 0; i < state.robots.size(); ++i)
        if (!soundCommands(scenario, state, i))
            return "robot " + std::to_string(i + 1) + " with a broken history of commands";
    for (const PendingKick& kick : state.kicks)
        if (kick.robot >= state.robots.size() ||
            kick.manipulator >= scenario.scene().typeOf(kick.robot).manipulators.size())
            return "a kick by a manipulator that is not there";
    const auto there = [&](std::uint32_t body) { return body < bodies || body == noBody; };
    for (const ContactImpulse& contact : state.contacts)
        if (!there(contact.bodyA) || !there(contact.bodyB)) return "a contact of a body that is not there";
    if (!allFinite(state.robots) || !allFinite(state.objects) || !allFinite(state.contacts) ||
        !allFinite(state.kicks) || !allFinite(state.commands) || !allFinite(state.past))
        return "a number that is not finite";
    return {};
}

}  // namespace mrose
