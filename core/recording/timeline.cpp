#include "recording/timeline.h"

#include <algorithm>
#include <cassert>

#include "recording/tick_decisions.h"
#include "scenario/first_version.h"
#include "world/second_state_version.h"
#include "world/state_bytes.h"

namespace mrose {

void TimelineBlock::add(const StateHash& after, const StepTrace& trace) {
    hashes.push_back(after);
    appendDecisions(trace, decisions);
}

std::int64_t usualKeyframeInterval(const WorldState& state) {
    // A tick takes about a microsecond a body; what is kept between keyframes must stay the larger part of the memory.
    constexpr std::size_t bodyTicks = 3500;
    const std::size_t bodies = std::max<std::size_t>(state.robots.size() + state.objects.size(), 1);
    return static_cast<std::int64_t>(std::clamp<std::size_t>(bodyTicks / bodies, 25, 500));
}

Timeline::Timeline(const WorldState& start, std::int64_t keyframeInterval)
    : blocks_{{start.tick, stateBytes(start), {}, {}}},
      size_(blocks_.front().size()),
      interval_(keyframeInterval > 0 ? keyframeInterval : usualKeyframeInterval(start)) {}

Timeline::Timeline(TimelineBlock first, std::int64_t keyframeInterval) : interval_(keyframeInterval) {
    assert(!first.keyframe.empty());
    if (interval_ <= 0)
        if (const auto state = parseState(first.keyframe, {})) interval_ = usualKeyframeInterval(*state);
    size_ = first.size();
    blocks_.push_back(std::move(first));
}

void Timeline::add(const WorldState& after, const StepTrace& trace) { add(after, trace, hashOf(after)); }

void Timeline::add(const WorldState& after, const StepTrace& trace, const StateHash& hash) {
    assert(after.tick == last() + 1);
    TimelineBlock& open = blocks_.back();
    size_ -= open.size();
    open.add(hash, trace);
    size_ += open.size();
    if (after.tick - open.first < interval_) return;
    open.hashes.shrink_to_fit();
    open.decisions.shrink_to_fit();
    blocks_.push_back({after.tick, stateBytes(after), {}, {}});
    size_ += blocks_.back().size();
}

SameHashes TimelineBlock::compare(const Scenario& scenario, const WorldState& state) const {
    const auto index = static_cast<std::size_t>(state.tick - 1 - first);
    const StateHash found = index < firstVersion ? firstVersionHash(scenario, state) : hashOf(state);
    // A recording of then may go on in a block with hashes of now.
    const bool second = !state.messages.empty() && found.world != hashes[index].world &&
                        secondVersionHash(state).world == hashes[index].world;
    return {found.world == hashes[index].world || second, found.memories == hashes[index].memories};
}

bool Timeline::append(TimelineBlock block) {
    if (block.first != last()) return false;
    size_ += block.size();
    if (block.keyframe.empty()) {
        TimelineBlock& open = blocks_.back();
        if (open.firstVersion == open.hashes.size()) open.firstVersion += block.firstVersion;
        open.hashes.insert(open.hashes.end(), block.hashes.begin(), block.hashes.end());
        open.decisions += block.decisions;
    } else {
        blocks_.push_back(std::move(block));
    }
    return true;
}

const TimelineBlock& Timeline::blockOf(std::int64_t tick) const {
    assert(tick >= first() && tick <= last());
    const auto after = std::upper_bound(blocks_.begin(), blocks_.end(), tick,
                                        [](std::int64_t t, const TimelineBlock& block) { return t < block.first; });
    return *(after - 1);
}

const StateHash& Timeline::hashAt(std::int64_t tick) const {
    assert(tick > first() && tick <= last());
    const TimelineBlock& block = blockOf(tick - 1);
    return block.hashes[static_cast<std::size_t>(tick - 1 - block.first)];
}

bool Timeline::forgetEarliest() {
    if (blocks_.size() < 2) return false;
    size_ -= blocks_.front().size();
    blocks_.pop_front();
    return true;
}

}  // namespace mrose
