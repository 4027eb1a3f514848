#include "debug/kick_cause.h"

#include <algorithm>

namespace mrose {

std::optional<KickCause> causeOfKick(const TimeTravel& run) {
    const BranchTree& branches = run.branches();
    std::int64_t until = run.tick();
    for (std::uint32_t at = run.branch();; at = branches[at].parent) {
        const BranchRecord& record = branches.record(at);
        for (auto mark = record.marks().rbegin(); mark != record.marks().rend(); ++mark) {
            if (mark->kind != TimelineMark::Kind::kick || mark->tick > until) continue;
            const Nanoseconds end = record.setup().scene().timeOf(mark->tick);
            for (std::uint32_t from = at;; from = branches[from].parent) {
                const std::vector<KickOrder>& orders = branches.record(from).kickOrders();
                for (auto order = orders.rbegin(); order != orders.rend(); ++order)
                    if (order->robot == mark->body && order->due < end) return KickCause{*order, mark->tick};
                if (branches[from].parent == from) break;
            }
        }
        if (branches[at].parent == at) return {};
        until = std::min(until, branches[at].tick);
    }
}

}  // namespace mrose
