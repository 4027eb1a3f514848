#pragma once

#include <string>
#include <vector>

#include "assessment/windows.h"
#include "motion/percent_errors.h"

namespace mrose {

/// Which pairs of stretches count as near-identically commanded.
struct FloorOptions {
    double pathBound = 0.005;  ///< m: largest difference of the integrals of v, from the lead's begin to any instant
    double rotationBound = 0.025;       ///< rad: likewise of w
    Nanoseconds horizon = 0;            ///< length of the stretches; 0: that of the windows
    double leastTurnRate = 0;           ///< rad/s: both stretches of a pair really turn at least so fast on average
    Nanoseconds lead = 1'000'000'000;   ///< commands before the start that must match too
    Nanoseconds spacing = 200'000'000;  ///< between starts tried in a long trajectory; a whole multiple of the step
};

/// Two stretches of one robot that were commanded alike within the bounds.
struct FloorPair {
    Window first, second;
    double commandDifference = 0;                ///< the larger of the two differences, in parts of its bound
    double positionMean = 0, positionFinal = 0;  ///< m: how their real paths differ, each seen from its own start
    double headingMean = 0, headingFinal = 0;    ///< rad, absolute
    double path = 0, rotation = 0;               ///< m, rad: mean of the two
};

/// How differently near-identical commands turn out: what no model that sees commands alone can predict. Two real
/// outcomes differ by the deviations of both, so the best possible prediction, their mean, is off by 1/sqrt 2 of it if
/// deviations are independent and alike.
struct Floor {
    FloorOptions options;
    Nanoseconds horizon = 0;       ///< of the longest stretch
    std::size_t tried = 0;         ///< stretches
    std::size_t candidates = 0;    ///< pairs of them within the bounds, sharing stretches
    std::vector<FloorPair> pairs;  ///< chosen of those, best match first: no two share an instant of a robot
    PercentErrors spread;          ///< of the pairs, between the two of each
    PercentErrors best;            ///< the spread / sqrt 2: what the best possible prediction would leave
};

/// Stretches are the horizon long: dense starts in trajectories that are long enough, else the trajectory's one
/// window. They satisfy the minima of windows. `robots` empty: all.
Floor findFloor(const Log& log, const std::vector<std::string>& robots, const WindowOptions& windows,
                const FloorOptions& options = {});

}  // namespace mrose
