#include "simulation/rewind_check.h"

#include <algorithm>

#include "io/format.h"
#include "world/state_difference.h"

namespace mrose {
namespace {

std::string text(const std::optional<Command>& command) {
    return command ? "v " + numberText(command->v) + ", w " + numberText(command->w) : "no command";
}

/// How two decisions differ in their commands; "" where they do not.
std::string difference(const Decision& a, const Decision& b) {
    const bool sameCommand =
        a.command.has_value() == b.command.has_value() && (!a.command || identical(*a.command, *b.command));
    if (!sameCommand) return text(a.command) + ", then " + text(b.command);
    if (!a.sameOrders(b)) return "other earlier commands or kicks";
    if (a.fault != b.fault)
        return (a.fault.empty() ? "no fault" : a.fault) + ", then " + (b.fault.empty() ? "no fault" : b.fault);
    return "";
}

bool sameMemory(const Scenario& scenario, const WorldState& a, const WorldState& b, std::size_t robot) {
    const auto first = scenario.memoryOf(a, robot), second = scenario.memoryOf(b, robot);
    return std::equal(first.begin(), first.end(), second.begin(), second.end());
}

}  // namespace

std::vector<RewindDifference> stepTwice(const Scenario& scenario, WorldState& state, StepBuffers& buffers,
                                        StepTrace& trace, const Overrides& overrides) {
    WorldState again = state;
    StepTrace second;
    second.asksInsights = trace.asksInsights;
    step(scenario, state, buffers, overrides, &trace);
    step(scenario, again, buffers, overrides, &second);
    std::vector<RewindDifference> differences;
    for (std::uint32_t i = 0; i < state.robots.size(); ++i) {
        const std::string decided = difference(trace.robots[i].decision, second.robots[i].decision);
        if (!decided.empty())
            differences.push_back({i, "its controller decided otherwise when it was asked again: " + decided});
        else if (!sameMemory(scenario, state, again, i))
            differences.push_back({i, "its controller remembered something else when it was asked again"});
    }
    if (!differences.empty()) return differences;
    if (const auto other = firstDifference(state, again)) differences.push_back({std::nullopt, other->message()});
    return differences;
}

}  // namespace mrose
