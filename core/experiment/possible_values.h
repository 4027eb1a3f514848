#pragma once

#include "condition/written_range.h"
#include "experiment/estimates.h"
#include "experiment/experiment_file.h"

namespace mrose {

/// Between what a measure's numbers lie as far as it says so itself: how often and how long are at least 0; else as of
/// writtenRange().
ValueRange possibleValues(const Measure& measure);

/// Between what the differences of two numbers lie that are of a range.
ValueRange possibleDifferences(const ValueRange& values);

/// With an interval that ends where a mean cannot be: of few numbers Student's goes beyond. Left as it is where the
/// number itself is not possible.
Estimate limited(const Estimate& estimate, const ValueRange& possible);

}  // namespace mrose
