#pragma once

#include <span>
#include <string>
#include <vector>

#include "assessment/kick_scores.h"
#include "manipulation/kick_network.h"

namespace mrose {

// As `mrose train --kicker --json` and `mrose evaluate --json` of a kicker print it.

/// `file`: the network's; `seconds`: how long it took.
std::string kickTrainingJson(const KickNetwork& network, const std::vector<std::string>& notices,
                             const std::string& file, double seconds);
std::string kickScoresJson(std::span<const KickScores> scores, bool synthetic, const std::vector<std::string>& notices);

}  // namespace mrose
