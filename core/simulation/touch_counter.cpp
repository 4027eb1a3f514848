#include "simulation/touch_counter.h"

#include <algorithm>

namespace mrose {

std::span<const TouchCounter::Pair> TouchCounter::add(const StepTrace& trace) {
    ++tick_;
    touching_.clear();
    for (const ContactReport& contact : trace.contacts)
        touching_.push_back({std::min(contact.bodyA, contact.bodyB), std::max(contact.bodyA, contact.bodyB)});
    std::sort(touching_.begin(), touching_.end());
    touching_.erase(std::unique(touching_.begin(), touching_.end()), touching_.end());
    std::erase_if(recent_, [&](const Recent& recent) { return tick_ - recent.tick > apartTicks_; });
    begun_.clear();
    merged_.clear();
    auto recent = recent_.begin();
    for (const Pair& pair : touching_) {
        for (; recent != recent_.end() && recent->pair < pair; ++recent) merged_.push_back(*recent);
        if (recent != recent_.end() && recent->pair == pair)
            ++recent;
        else
            begun_.push_back(pair);
        merged_.push_back({pair, tick_});
    }
    merged_.insert(merged_.end(), recent, recent_.end());
    std::swap(recent_, merged_);
    return begun_;
}

}  // namespace mrose
