#include "recording/playback.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "recording/decision_bytes.h"
#include "world/state_bytes.h"
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
    const WorldState own = scenario.initialState();
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

tl::unexpected<Error> notKept(const Timeline& timeline, std::int64_t tick) {
    return fail({}, "tick " + std::to_string(tick) + " is not kept; expected one of " +
                        std::to_string(timeline.first()) + " ... " + std::to_string(timeline.last()));
}

tl::unexpected<Error> damaged(std::int64_t tick) {
    return fail({}, "the decisions of tick " + std::to_string(tick) + " are damaged");
}

void checkHashes(ReachedState& reached, const StateHash& expected) {
    const StateHash found = hashOf(reached.state);
    reached.worldSame = found.world == expected.world;
    reached.mindsSame = found.minds == expected.minds;
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

Expected<ReachedState> Playback::reachBy(bool asking, const TimelineBlock& block, const StateHash* expected,
                                         std::int64_t tick) {
    Expected<WorldState> state = parseState(block.keyframe, "keyframe of tick " + std::to_string(block.first));
    if (!state) return tl::unexpected(state.error());
    if (const std::string wrong = misfit(scenario_, *state); !wrong.empty() || state->tick != block.first)
        return fail({}, "the state kept of tick " + std::to_string(block.first) + " is none of this scenario: it has " +
                            (wrong.empty() ? "another tick" : wrong));
    DecisionReader reader(block.decisions);
    while (state->tick < tick) {
        if (!reader.next(asking ? DecisionsOf::outside : DecisionsOf::all)) return damaged(state->tick);
        step(scenario_, *state, buffers_, {reader.decisions(), asking});
    }
    ReachedState reached{std::move(*state)};
    reached.read = block.decisions.size() - reader.rest();
    if (expected != nullptr && tick > block.first) checkHashes(reached, *expected);
    return reached;
}

Expected<ReachedState> Playback::reach(const Timeline& timeline, std::int64_t tick) {
    if (tick < timeline.first() || tick > timeline.last()) return notKept(timeline, tick);
    const TimelineBlock& block = timeline.blockOf(tick);
    const StateHash* const expected = tick > timeline.first() ? &timeline.hashAt(tick) : nullptr;
    if (askControllers_) {
        Expected<ReachedState> reached = reachBy(true, block, expected, tick);
        if (!reached || (reached->worldSame && reached->mindsSame)) return reached;
    }
    Expected<ReachedState> reached = reachBy(false, block, expected, tick);
    // Where not even the recorded decisions give the same, it is not the controllers' fault.
    if (reached && reached->worldSame) askControllers_ = false;
    return reached;
}

Expected<void> Playback::advance(const Timeline& timeline, ReachedState& from, StepTrace& trace) {
    const std::int64_t tick = from.state.tick;
    if (tick < timeline.first() || tick >= timeline.last()) return notKept(timeline, tick + 1);
    const TimelineBlock& block = timeline.blockOf(tick);
    if (block.first == tick) from.read = 0;
    const std::string_view decisions = block.decisions;
    const StateHash& expected = timeline.hashAt(tick + 1);
    for (const bool asking : {true, false}) {
        if (asking && !askControllers_) continue;
        DecisionReader reader(decisions.substr(std::min(from.read, decisions.size())));
        if (!reader.next(asking ? DecisionsOf::outside : DecisionsOf::all)) return damaged(tick);
        ReachedState next{from.state, from.worldSame, from.mindsSame, decisions.size() - reader.rest()};
        step(scenario_, next.state, buffers_, {reader.decisions(), asking}, &trace);
        checkHashes(next, expected);
        const bool same = next.worldSame && next.mindsSame;
        if (!asking && next.worldSame) askControllers_ = false;
        if (same || !asking) {
            from = std::move(next);
            break;
        }
    }
    return {};
}

}  // namespace mrose
