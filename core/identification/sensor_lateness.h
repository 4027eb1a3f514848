#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace mrose {

/// How long before its stamp a sensor measured.
struct SensorLateness {
    bool identified = false;
    std::string reason = {};  ///< why it is not; empty when it is
    double lateness = 0;      ///< s; negative: stamped too early
    double error = 0;         ///< s, one standard error, from blocks of 10 s
};

/// What a sensor reported less what the ground truth says of an earlier instant.
struct LateMisfits {
    std::vector<std::int32_t> blocks;  ///< of 10 s: within one, errors are not independent
    std::vector<std::int32_t> kinds;   ///< from 0: of one unit, each with an offset and a noise of its own
    /// For an assumed lateness [s]; NaN where there is no truth.
    std::function<std::vector<double>(double lateness)> at;
};

/// The lateness at which misfits do not depend on motion, beside an offset of each kind: robust least squares (Tukey's
/// weights) from the best point of a coarse grid, as the truth is read anew at each step. What turns quickly decides:
/// of a bearing, a sensor that is late by L is off by L times the robot's rotation rate. Not identified: with fewer
/// than 100 misfits, when none between -0.5 and 2 s fits, or when the standard error exceeds 0.1 s.
SensorLateness fitLateness(const LateMisfits& misfits);

}  // namespace mrose
