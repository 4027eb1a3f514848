#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "manipulation/kick_sample.h"
#include "manipulation/learned_kicker.h"

namespace mrose {

/// How one description of a kicker predicts the kicks of a log, that met the ball unless said otherwise.
struct KickScores {
    /// Of one of delay (s), speed (m/s), direction (rad).
    struct Quantity {
        double crps = 0;                    ///< continuous ranked probability score, in its unit
        double inside50 = 0, inside90 = 0;  ///< shares within the central 50 and 90 % of what is predicted
    };
    std::string name;
    std::size_t kicks = 0, hits = 0;
    double hit = 0;                   ///< mean log-likelihood of whether the ball left, of all kicks
    double delay = 0, departure = 0;  ///< likewise of densities; -infinity: a point predicts nothing of them
    std::array<Quantity, 3> quantities{};
};

/// A learned kicker, then what its network says of one that is the same every time: with constant noise
/// ("analytic plus noise"), and without ("analytic"), as robot files describe one without a network.
std::vector<KickScores> scoreKicks(const LearnedKicker& kicker, std::span<const KickSample> kicks,
                                   const std::string& name);

}  // namespace mrose
