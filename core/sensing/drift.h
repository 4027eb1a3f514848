#pragma once

#include <cmath>

#include "geometry/elementary.h"

namespace mrose {

/// A bias that drifts: a first-order autoregressive process in its exact discretisation, stationary from the first
/// measurement on.
struct Drift {
    double kept = 0, added = 1;  ///< what is left of it from one measurement to the next, and what that adds

    /// A bias that has not begun is exactly zero: no draw leads there.
    Drift(bool begun, double seconds, double correlationTime) {
        if (!begun) return;
        kept = decay(seconds / correlationTime);
        added = std::sqrt(1 - kept * kept);
    }
    double operator()(double bias, double deviation, double draw) const {
        return kept * bias + added * deviation * draw;
    }
};

}  // namespace mrose
