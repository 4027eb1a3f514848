#pragma once

#include <string>

#include "validation/validation_results.h"

namespace mrose {

// Pictures of a validation, as <svg> elements: the simulator is blue, the reality orange.

/// The four cells with their intervals, before and after joined in each place.
std::string cellFigure(const Validation& validation, const MeasureValidation& of);
/// Each trial's gain in the simulator and in the reality.
std::string pairedGainFigure(const Validation& validation, const MeasureValidation& of);
/// Shares of the trials up to each gain, in both places.
std::string gainDistributionFigure(const Validation& validation, const MeasureValidation& of);
/// What the colours mean.
std::string placeLegend(const Validation& validation);

}  // namespace mrose
