#include "experiment/touch_counter.h"

#include <algorithm>

namespace mrose {

std::span<const TouchCounter::Pair> TouchCounter::add(const StepTrace& trace) {
    std::swap(touching_, before_);
    touching_.clear();
    for (const ContactReport& contact : trace.contacts)
        touching_.push_back({std::min(contact.bodyA, contact.bodyB), std::max(contact.bodyA, contact.bodyB)});
    std::sort(touching_.begin(), touching_.end());
    touching_.erase(std::unique(touching_.begin(), touching_.end()), touching_.end());
    begun_.clear();
    std::set_difference(touching_.begin(), touching_.end(), before_.begin(), before_.end(), std::back_inserter(begun_));
    return begun_;
}

}  // namespace mrose
