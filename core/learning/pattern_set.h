#pragma once

#include "learning/pattern_matrix.h"

namespace mrose {

/// Inputs and the outputs wanted for them, pattern by pattern, standardised.
struct PatternSet {
    PatternMatrix inputs, targets;
};

}  // namespace mrose
