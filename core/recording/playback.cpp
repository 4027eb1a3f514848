#include "recording/playback.h"

#include <algorithm>
#include <string_view>

#include "recording/tick_decisions.h"
#include "scenario/first_version.h"

namespace mrose {
namespace {

tl::unexpected<Error> notKept(const Timeline& timeline, std::int64_t tick) {
    return fail({}, "tick " + std::to_string(tick) + " is not kept; expected one of " +
                        std::to_string(timeline.first()) + " ... " + std::to_string(timeline.last()));
}

tl::unexpected<Error> damaged(std::int64_t tick) {
    return fail({}, "the decisions of tick " + std::to_string(tick) + " are damaged");
}

void checkHashes(const Scenario& scenario, const TimelineBlock& block, ReachedState& reached) {
    const SameHashes same = block.compare(scenario, reached.state);
    reached.worldSame = same.world;
    reached.memoriesSame = same.memories;
}

}  // namespace

Expected<ReachedState> Playback::reachBy(bool asking, const TimelineBlock& block, std::int64_t tick) {
    Expected<WorldState> state =
        parseStateOf(scenario_, block.keyframe, "keyframe of tick " + std::to_string(block.first));
    if (!state) return tl::unexpected(state.error());
    if (const std::string wrong = validate(scenario_, *state); !wrong.empty() || state->tick != block.first)
        return fail({}, "the state kept of tick " + std::to_string(block.first) + " is none of this scenario: it has " +
                            (wrong.empty() ? "another tick" : wrong));
    DecisionReader reader(block.decisions);
    while (state->tick < tick) {
        if (!reader.next(asking ? DecisionsOf::outside : DecisionsOf::all)) return damaged(state->tick);
        step(scenario_, *state, buffers_, {reader.decisions(), asking});
    }
    ReachedState reached{std::move(*state)};
    reached.read = block.decisions.size() - reader.rest();
    if (tick > block.first) checkHashes(scenario_, block, reached);
    return reached;
}

Expected<ReachedState> Playback::reach(const Timeline& timeline, std::int64_t tick) {
    if (tick < timeline.first() || tick > timeline.last()) return notKept(timeline, tick);
    const TimelineBlock& block = timeline.blockOf(tick);
    if (askControllers_) {
        Expected<ReachedState> reached = reachBy(true, block, tick);
        if (!reached || (reached->worldSame && reached->memoriesSame)) return reached;
    }
    Expected<ReachedState> reached = reachBy(false, block, tick);
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
    for (const bool asking : {true, false}) {
        if (asking && !askControllers_) continue;
        DecisionReader reader(decisions.substr(std::min(from.read, decisions.size())));
        if (!reader.next(asking ? DecisionsOf::outside : DecisionsOf::all)) return damaged(tick);
        ReachedState next{from.state, from.worldSame, from.memoriesSame, decisions.size() - reader.rest()};
        step(scenario_, next.state, buffers_, {reader.decisions(), asking}, &trace);
        checkHashes(scenario_, block, next);
        const bool same = next.worldSame && next.memoriesSame;
        if (!asking && next.worldSame) askControllers_ = false;
        if (same || !asking) {
            from = std::move(next);
            break;
        }
    }
    return {};
}

}  // namespace mrose
