#include "recording/history.h"

#include <algorithm>
#include <cassert>

namespace mrose {

History::History(const WorldState& initial, const Options& options) : options_(options) {
    branches_.push_back({0, initial.tick, "", Timeline(initial, options.keyframeInterval)});
}

History::History(std::vector<Branch> branches, const Options& options)
    : options_(options), branches_(std::move(branches)) {
    assert(!branches_.empty());
}

std::uint32_t History::beginBranch(std::uint32_t parent, const WorldState& state, std::string name,
                                   ScenarioValuePointer value) {
    assert(parent < branches_.size());
    if (!value) value = branches_[parent].value;
    branches_.push_back(
        {parent, state.tick, std::move(name), Timeline(state, options_.keyframeInterval), std::move(value)});
    return static_cast<std::uint32_t>(branches_.size() - 1);
}

void History::add(const WorldState& after, const StepTrace& trace, std::uint32_t branch) {
    branches_[branch].timeline.add(after, trace);
    if (branches_[branch].timeline.last() == branches_[branch].timeline.blocks().back().first) forgetWhatIsTooMuch();
}

std::size_t History::size() const {
    std::size_t size = 0;
    for (const Branch& branch : branches_) size += branch.timeline.size();
    return size;
}

void History::forgetWhatIsTooMuch() {
    while (size() > options_.mostBytes) {
        // The earliest ticks of all branches that have more than their last block.
        const auto earlier = [](const Branch& a, const Branch& b) {
            const bool canA = a.timeline.blocks().size() > 1, canB = b.timeline.blocks().size() > 1;
            return canA != canB ? canA : a.timeline.first() < b.timeline.first();
        };
        if (!std::min_element(branches_.begin(), branches_.end(), earlier)->timeline.forgetEarliest()) return;
    }
}

}  // namespace mrose
