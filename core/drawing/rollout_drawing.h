#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "geometry/pose.h"
#include "geometry/pose_region.h"
#include "scene/environment.h"

namespace mrose {

/// What a robot really drove and what its simulation did, at the same instants. A pose that is not finite interrupts a
/// path; `simulated` may be empty.
struct DrawnRollout {
    std::string name;  ///< written beside the start
    std::vector<Pose> real, simulated;
    std::string miss;                        ///< written beside the ends: how far they are apart; may be empty
    std::optional<std::size_t> leaves = {};  ///< where it leaves the real trajectory, in `simulated`: a ring
    std::vector<PoseRegion> regions = {};    ///< where it may be, by samples, at instants of its own; may be empty
};

struct RolloutPicture {
    std::string title, subtitle;
    std::size_t arrowEvery = 10;  ///< poses, between the heading arrows along a path
    std::string arrowInterval;    ///< that in words: "every second"
    std::string real = "real";    ///< what the real robots and paths are called
};

/// Robots on their ways through an environment, with a scale bar and a legend: a picture that speaks for itself. Real
/// paths are broad and orange, simulated ones narrow and blue above them, so that both are seen where they coincide;
/// the two colours differ for every eye. It shows what lies round the paths.
std::string drawRollouts(const Environment& environment, const RolloutPicture& picture,
                         std::span<const DrawnRollout> rollouts);

}  // namespace mrose
