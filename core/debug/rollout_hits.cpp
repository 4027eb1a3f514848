#include "debug/rollout_hits.h"

#include <algorithm>

namespace mrose {

void RolloutHits::learn(std::size_t rollout, std::span<const BreakpointState> states) {
    for (const BreakpointState& state : states) {
        std::int64_t& hits = hits_[state.breakpoint.text][rollout];
        hits = std::max(hits, state.inRun);
    }
}

HitsInOtherRuns RolloutHits::elsewhere(std::size_t rollout) const {
    HitsInOtherRuns met;
    for (const auto& [text, rollouts] : hits_)
        for (const auto& [at, hits] : rollouts)
            if (at != rollout) (at < rollout ? met.before : met.after)[text] += hits;
    return met;
}

}  // namespace mrose
