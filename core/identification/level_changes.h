#pragma once

#include <span>
#include <vector>

#include "world/time.h"

namespace mrose {

struct StampedMisfit {
    Nanoseconds time = 0;
    double value = 0;
};

/// A stretch of time over which misfits had another level than usual.
struct LevelChange {
    Nanoseconds begin = 0, end = 0;
    double offset = 0, error = 0;  ///< from the usual level, with one standard error by the stretch's own spread
};

/// Stretches over which misfits, in ascending time, are off their median `usual` by more than `least` and by more than
/// five standard errors, for at least 4 s. Medians of 2 s are divided into pieces of constant level, as many as pay for
/// themselves (optimal partitioning; Jackson et al. 2005, An algorithm for optimal partitioning of data on an
/// interval); single misfits then say where a piece begins. No stretch goes on across a pause of 10 s. Misfits beyond
/// `most` count for nothing.
std::vector<LevelChange> levelChanges(std::span<const StampedMisfit> misfits, double usual, double least, double most);

}  // namespace mrose
