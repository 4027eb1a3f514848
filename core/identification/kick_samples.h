#pragma once

#include <string>
#include <vector>

#include "logs/robot_log.h"
#include "manipulation/kick_sample.h"

namespace mrose {

/// The kicks of some logs, as far as tracked ball and robot say what became of them.
struct KickSamples {
    std::vector<KickSample> kicks;  ///< in the order of the logs
    std::size_t commanded = 0;      ///< all that the logs have
    std::size_t unseen = 0;         ///< left out: the ball or the robot was not tracked then
    std::size_t unclear = 0;        ///< left out: the ball moved before, or did not leave as a kicked one does
    std::size_t far = 0;            ///< left out: the ball lay where none was kicked

    std::size_t hits() const;
};

struct KickSampleOptions {
    double longestDelay = 0.6;  ///< s, from the command to when the ball leaves
    double still = 0.03;        ///< m: a ball that moves by less has not left
    double margin = 0.05;       ///< m: so far beyond where balls were hit a miss still counts
};

/// A kick is a hit where a ball that lay still moves within `longestDelay`; its speed and direction are those of the
/// path fitted to it afterwards, where that begins.
KickSamples kickSamples(const std::vector<Log>& logs, const KickSampleOptions& options = {});

}  // namespace mrose
