#include "report/validation_text.h"

#include <algorithm>
#include <cmath>

#include "io/format.h"

namespace mrose {
namespace {

constexpr double inPercent = 100;

double shown(const ValidatedMeasure& measure, double value) { return measure.yesNo ? inPercent * value : value; }

/// Three figures, but no more decimals than a reader wants, nor than the interval leaves.
int decimalsOf(const ValidatedMeasure& measure, const Estimate& of) {
    if (measure.yesNo) return 1;
    const double width = 0.5 * (of.high - of.low);
    const double size = std::isfinite(width) ? std::max(std::abs(of.value), width) : std::abs(of.value);
    return size >= 100 ? 1 : size >= 1 ? 2 : size >= 0.1 ? 3 : 4;
}

std::string numberOf(double value, int decimals, const std::string& minus) {
    const std::string text = fixed(std::abs(value), decimals);
    return value < 0 ? minus + text : text;
}

}  // namespace

std::string measuredText(const ValidatedMeasure& measure, const Estimate& value, const std::string& minus) {
    const std::string number = numberOf(shown(measure, value.value), decimalsOf(measure, value), minus);
    const std::string unit = measure.yesNo ? "%" : measure.unit;
    return unit.empty() ? number : number + ' ' + unit;
}

std::string differenceText(const ValidatedMeasure& measure, const Estimate& value, const std::string& minus) {
    const std::string number = numberOf(shown(measure, value.value), decimalsOf(measure, value), minus);
    const std::string unit = measure.yesNo ? "points" : measure.unit;
    return (value.value > 0 ? "+" : "") + number + (unit.empty() ? "" : ' ' + unit);
}

std::string intervalText(const ValidatedMeasure& measure, const Estimate& estimate, const std::string& minus) {
    if (!std::isfinite(estimate.low)) return "not known";
    const int decimals = decimalsOf(measure, estimate);
    return numberOf(shown(measure, estimate.low), decimals, minus) + " to " +
           numberOf(shown(measure, estimate.high), decimals, minus);
}

std::string worseText(const ValidatedMeasure& measure, const Estimate& worse, const std::string& minus) {
    if (!std::isfinite(worse.value)) return "not known";
    const bool better = worse.value < 0;
    const Estimate by = better ? Estimate(-worse.value, -worse.high, -worse.low) : worse;
    const std::string number = numberOf(shown(measure, by.value), decimalsOf(measure, by), minus);
    const std::string unit = measure.yesNo ? "points" : measure.unit;
    return (better ? "better by " : "worse by ") + number + (unit.empty() ? "" : ' ' + unit) + " (" +
           intervalText(measure, by, minus) + ')';
}

std::string survivesText(const MeasureValidation& of, const std::string& minus) {
    if (!std::isfinite(of.survives.value)) return "not known: the gain in the simulator may be none";
    return numberOf(inPercent * of.survives.value, 0, minus) + " % (" +
           numberOf(inPercent * of.survives.low, 0, minus) + " to " + numberOf(inPercent * of.survives.high, 0, minus) +
           ')';
}

}  // namespace mrose
