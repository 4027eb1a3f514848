#pragma once

#include "perception/reading_distribution.h"

namespace mrose {

/// The noise of an ideal sensor that is the same everywhere: what a learned one is compared with.
struct ConstantNoise {
    /// Probabilities that a subject is reported: of one in view with nothing before it, and of any other.
    double seen = 0.5, unseen = 0.5;
    ReadingError spread{};  ///< standard deviation of the errors about 0, by dimension
    bool operator==(const ConstantNoise&) const = default;
};

}  // namespace mrose
