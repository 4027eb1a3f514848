#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "world/time.h"

namespace mrose {

/// Which player of a team goes: the one that it costs least, by what each tells of its own cost. Every player chooses
/// by itself. So that all choose alike though they hear each other late, time is cut into slots, and a choice is of
/// what was told some slots ago, which all have heard by now, but for what got lost. Who went goes on as long as no
/// other would be better by the hysteresis; equal costs go to the first in the team. Part of a controller's memory; all
/// zero nobody goes.
struct RoleChoice {
    static constexpr std::size_t most = 12;  ///< players
    static constexpr std::size_t kept = 8;   ///< slots
    static constexpr Nanoseconds slotLength = 100'000'000;

    enum Says : std::int64_t { nothing, offers, goes };
    struct Bid {
        Nanoseconds told;
        double cost;  ///< infinite: it cannot go
        Says says;
    };
    struct Options {
        double hysteresis = 0;    ///< of cost
        std::int64_t agree = 2;   ///< slots, 0 to kept - 2: what was told since is not yet chosen by
        std::int64_t forget = 8;  ///< slots: who told nothing for so long is out of it; at most kept
    };

    std::array<std::array<Bid, kept>, most> bids;  ///< of each player the newest first, the last one of each slot
    std::int64_t goer;                             ///< 1 more than the player's place in the team; 0: nobody
    Nanoseconds since;                             ///< when that was chosen
    std::int64_t switches;                         ///< how often one has taken over from another

    static std::int64_t slotOf(Nanoseconds time) { return time / slotLength; }

    /// What a player, also this one itself, told of itself.
    void note(std::size_t player, const Bid& bid);
    void choose(Nanoseconds now, const Options& options);
    /// What it told last; nullopt: nothing.
    std::optional<Bid> newest(std::size_t player) const;

private:
    struct View;
    static std::int64_t firstHeard(const View& view);
    std::int64_t incumbent(const View& view, std::int64_t slot, const Options& options) const;
};
static_assert(sizeof(RoleChoice) == (RoleChoice::most * RoleChoice::kept * 3 + 3) * 8, "without padding");

}  // namespace mrose
