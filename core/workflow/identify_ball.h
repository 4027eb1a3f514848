#pragma once

#include <string>
#include <vector>

#include "identification/ball_identification.h"
#include "io/error.h"
#include "io/progress.h"

namespace mrose {

/// Of which log the ball is to be identified.
struct IdentifyBallRequest {
    std::string log;
    std::vector<std::string> robots = {};  ///< that it may touch, and whose trajectories have it; empty: all
    std::string environment = {};          ///< a file: how the walls lie; empty: not known
    std::string output = {};               ///< for the keys; empty: they are written nowhere
    bool overwrite = false;
};

/// Error: the log cannot be read or has no ball that moves; the environment is none; the file cannot be written or is
/// there already; it was cancelled.
Expected<BallIdentification> identifyBall(const IdentifyBallRequest& request, const Progress& progress = {});

}  // namespace mrose
