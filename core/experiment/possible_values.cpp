#include "experiment/possible_values.h"

#include <algorithm>

namespace mrose {

ValueRange possibleValues(const Measure& measure) {
    if (measure.of >= Measure::Of::seconds) return {.least = 0};
    return writtenRange(measure.expression.text);
}

ValueRange possibleDifferences(const ValueRange& values) {
    const double width = values.most - values.least;
    return {-width, width};
}

Estimate limited(const Estimate& estimate, const ValueRange& possible) {
    if (!(estimate.value >= possible.least && estimate.value <= possible.most)) return estimate;
    return {estimate.value, std::max(estimate.low, possible.least), std::min(estimate.high, possible.most)};
}

}  // namespace mrose
