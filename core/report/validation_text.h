#pragma once

#include <string>

#include "validation/validation_results.h"

namespace mrose {

// Numbers of a validation for people, on pages and in the terminal. Signs are those of `minus`: "-" or "\u2212". A
// value and its interval have the same decimals.

/// "12.3 s", of yes and no "93.1 %".
std::string measuredText(const ValidatedMeasure& measure, const Estimate& value, const std::string& minus = "-");
std::string measuredText(const ValidatedMeasure& measure, double value, const std::string& minus = "-");
/// Of a difference, with its sign: "+1.20 s", of yes and no "-3.4 points".
std::string differenceText(const ValidatedMeasure& measure, const Estimate& value, const std::string& minus = "-");
/// "1.10 to 1.30", without the unit; "not known" where it has none.
std::string intervalText(const ValidatedMeasure& measure, const Estimate& estimate, const std::string& minus = "-");
/// "better by 1.20 s", "worse by 3.4 points", or, where the interval as it is shown holds 0, "no difference shown".
std::string gainText(const ValidatedMeasure& measure, const Estimate& gain);
/// "worse by 1.20 s (1.10 to 1.30)", "no difference shown (+0.10 s, -0.20 to 0.40)".
std::string gainWithIntervalText(const ValidatedMeasure& measure, const Estimate& gain, const std::string& minus = "-");
/// The gain ratio, "87 % (80 to 95)", or why it is not known.
std::string survivesText(const MeasureValidation& of, const std::string& minus = "-");

}  // namespace mrose
