#pragma once

#include "planning/path.h"

namespace mrose {

struct ViaPointOptions {
    double spare = 0.05;  ///< m, between a via point and the growth of the piece that it is beside
    int most = 4;         ///< pieces that are gone round one within another
};

/// Straight where that is free. Otherwise beside the first piece in the way, on either side, by one via point at its
/// middle or, where that does not do, two at its ends; each leg is planned likewise, and the shortest way counts. Quick
/// and simple; it may miss a way that there is.
Path viaPointPath(const DiscSpace& space, const Point& start, const Point& goal, const ViaPointOptions& options = {});

}  // namespace mrose
