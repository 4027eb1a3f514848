#include "behaviour/role_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrose {
namespace {

/// Slots until a choice shows in what all tell, where nothing is waited for.
constexpr std::int64_t shownAfter = 3;

}  // namespace

/// Of each player what it told last of what counts now; nullptr: nothing.
struct RoleChoice::View {
    std::array<const Bid*, most> bids{};

    bool isCandidate(std::size_t player) const { return bids[player] != nullptr && std::isfinite(bids[player]->cost); }
};

void RoleChoice::note(std::size_t player, const Bid& bid) {
    std::array<Bid, kept>& all = bids[player];
    auto place = all.begin();
    while (place != all.end() && place->says != nothing && slotOf(place->told) > slotOf(bid.told)) ++place;
    if (place == all.end()) return;
    const bool sameSlot = place->says != nothing && slotOf(place->told) == slotOf(bid.told);
    if (sameSlot && place->told > bid.told) return;
    if (!sameSlot) std::move_backward(place, all.end() - 1, all.end());
    *place = bid;
}

std::optional<RoleChoice::Bid> RoleChoice::newest(std::size_t player) const {
    const Bid& bid = bids[player].front();
    return bid.says == nothing ? std::optional<Bid>() : bid;
}

/// Who went by what is told: as soon as the last choice must show in it, whoever says so (of several the cheapest), and
/// nobody where the chosen one says that it does not. So choices that differed become one again.
std::int64_t RoleChoice::incumbent(const View& view, std::int64_t slot, const Options& options) const {
    const std::int64_t chosen = slotOf(since);
    if (slot < chosen + std::max(options.agree, shownAfter)) return goer;
    std::int64_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < most; ++i) {
        const Bid* const bid = view.bids[i];
        if (bid == nullptr || bid->says != goes || slotOf(bid->told) < chosen || (best != 0 && bid->cost >= least))
            continue;
        least = bid->cost;
        best = static_cast<std::int64_t>(i) + 1;
    }
    if (best != 0 || goer == 0) return best;
    const Bid* const its = view.bids[static_cast<std::size_t>(goer - 1)];
    return its != nullptr && its->says != goes && slotOf(its->told) >= chosen ? 0 : goer;
}

/// 0: nobody.
std::int64_t RoleChoice::firstHeard(const View& view) {
    const auto first = std::ranges::find_if(view.bids, [](const Bid* bid) { return bid != nullptr; });
    return first == view.bids.end() ? 0 : first - view.bids.begin() + 1;
}

void RoleChoice::choose(Nanoseconds now, const Options& options) {
    const std::int64_t slot = slotOf(now);
    View view;
    for (std::size_t i = 0; i < most; ++i)
        for (const Bid& bid : bids[i]) {
            const std::int64_t age = slot - slotOf(bid.told);
            if (bid.says == nothing || age > options.forget) break;
            if (age < options.agree) continue;
            view.bids[i] = &bid;
            break;
        }
    const std::int64_t went = incumbent(view, slot, options);
    std::int64_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < most; ++i) {
        if (!view.isCandidate(i)) continue;
        const auto player = static_cast<std::int64_t>(i) + 1;
        const double cost = view.bids[i]->cost - (player == went ? options.hysteresis : 0);
        if (cost >= least) continue;
        least = cost;
        best = player;
    }
    if (best == 0) best = went != 0 ? went : firstHeard(view);  // nobody can go: all agree nevertheless
    if (best == 0 || best == goer) return;
    switches += goer != 0 ? 1 : 0;
    goer = best;
    since = now;
}

}  // namespace mrose
