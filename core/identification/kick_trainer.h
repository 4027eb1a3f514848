#pragma once

#include <cstdint>

#include "identification/kick_samples.h"
#include "io/error.h"
#include "io/progress.h"
#include "manipulation/kick_network.h"

namespace mrose {

/// How a kicker is learned. Parts of the kicks are held out in turn: that gives the held-out score, says when to stop,
/// and makes the members, each learned without one part (ReadingForm).
struct KickTrainerOptions {
    int components = 2;  ///< of a member's mixture
    int folds = 5;       ///< and members; at most ReadingForm::maxMembers
    int hidden = 8;      ///< units of each part of a member
    int epochs = 800;    ///< at most
    int patience = 200;
    double weightDecay = 1e-3;
    std::uint64_t seed = 1;
};

/// Learns delay, departure, and whether a kick meets the ball, by maximum likelihood. Where fewer than 10 kicks met it,
/// or missed it, their share is the same everywhere. A power or motion that is the same in all kicks is no input that
/// anything depends on. Runs in the caller's oneTBB arena; the same samples, options and seed give the same network
/// whatever the number of threads. Error: fewer than 40 hits; likelihoods that are no numbers; `progress` ended it.
Expected<KickNetwork> trainKicker(const KickSamples& samples, const KickTrainerOptions& options = {},
                                  const Progress& progress = {});

}  // namespace mrose
