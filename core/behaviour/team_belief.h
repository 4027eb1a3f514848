#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "behaviour/ball_belief.h"
#include "behaviour/ball_track.h"
#include "behaviour/own_belief.h"
#include "control/observation.h"

namespace mrose {

/// What a player tells its team, as a message: what it believes of itself and has seen of the ball, when it sends.
struct TeamWord {
    static constexpr std::uint32_t kind = 0x7465616d;
    enum Role : std::int64_t { supports, goes, keeps };
    static constexpr float nowhere = 1e6F;

    Pose pose;
    Velocity velocity;
    double poseVariance;       ///< m2, of its place
    Point ball, ballVelocity;  ///< by its own sightings alone: hearsay does not come round again
    double ballVariance;       ///< m2; 0: it has not seen it, or lost it
    Nanoseconds ballSeen;
    /// Two robots of no mate's, as it sees them, those nearest to the ball; beyond `nowhere` / 2 there is none.
    struct Seen {
        float x, y;  ///< m
    };
    std::array<Seen, 2> others;
    double cost;  ///< of its going for the ball (RoleChoice); infinite where it cannot tell
    std::int64_t role;
};
static_assert(sizeof(TeamWord) == 16 * 8 && std::is_trivially_copyable_v<TeamWord>, "without padding");

/// What a player's team mates told it last, by radio: late, out of order, and not all of it. Part of a controller's
/// memory; all zero nobody has told it anything.
struct TeamBelief {
    static constexpr std::size_t most = 12;  ///< in a team
    static constexpr Nanoseconds forgetAfter = nanosecondsPerSecond;

    struct Mate {
        TeamWord word;
        Nanoseconds told;
        std::int64_t known;  ///< 0: it has not told anything yet

        /// Where it is now, if it went on as it did, for half a second at most.
        Pose at(Nanoseconds now) const;
        bool isHeard(Nanoseconds now) const { return known != 0 && now - told <= forgetAfter; }
    };
    std::array<Mate, most> mates;  ///< by their places in the team

    /// `sender` sits at `place` of the team. What is older than what is known, or no word of finite numbers, is passed
    /// over; whether it was taken in.
    bool hear(const ReceivedMessage& message, std::size_t place);
    /// The ball now, by all that is known of it: what was seen surest, and what agrees with it, weighted by how sure
    /// it is. `own`: by own sightings. Not known where nobody knows it.
    BallBelief ball(const BallTrack& own, const OwnBelief& self, const BallFloor& floor, Nanoseconds now) const;
};
static_assert(sizeof(TeamBelief) == TeamBelief::most * (16 + 2) * 8, "without padding");

}  // namespace mrose
