#include "debug/kick_cause.h"

#include <algorithm>

namespace mrose {
namespace {

/// Of the ticks before the shown one in a run's lineage, the last of these events that `fits`.
template <typename Fits>
std::optional<KickEvent> lastBefore(const TimeTravel& run,
                                    const std::vector<KickEvent>& (BranchRecord::*events)() const, Fits fits) {
    const std::vector<BranchTicks> parts = run.branches().parts(run.branch());
    for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
        const std::vector<KickEvent>& all = (run.branches().record(part->branch).*events)();
        const auto found = std::find_if(all.rbegin(), all.rend(), [&](const KickEvent& event) {
            return event.tick <= std::min(part->last, run.tick() - 1) && fits(event);
        });
        if (found != all.rend()) return *found;
    }
    return {};
}

}  // namespace

std::optional<KickCause> causeOfKick(const TimeTravel& run) {
    const auto kick = lastBefore(run, &BranchRecord::carriedOutKicks, [](const KickEvent&) { return true; });
    if (!kick) return {};
    const auto order = lastBefore(run, &BranchRecord::orderedKicks, [&](const KickEvent& event) {
        return event.tick <= kick->tick && event.robot == kick->robot && event.manipulator == kick->manipulator &&
               event.due == kick->due;
    });
    if (!order) return {};
    return KickCause{*order, kick->tick + 1};
}

}  // namespace mrose
