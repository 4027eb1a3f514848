#include "report/validation_text.h"

#include <algorithm>
#include <cmath>

#include "io/format.h"

namespace mrose {
namespace {

constexpr double inPercent = 100;

double shown(const ValidatedMeasure& measure, double value) { return measure.yesNo ? inPercent * value : value; }

/// Three figures, but no more decimals than a reader wants.
int decimalsOf(const ValidatedMeasure& measure, double value) {
    if (measure.yesNo) return 1;
    const double size = std::abs(value);
    return size >= 100 ? 1 : size >= 1 ? 2 : size >= 0.1 ? 3 : 4;
}

std::string numberOf(double value, int decimals, const std::string& minus) {
    const std::string text = fixed(std::abs(value), decimals);
    return value < 0 ? minus + text : text;
}

}  // namespace

std::string measuredText(const ValidatedMeasure& measure, double value, const std::string& minus) {
    const std::string number = numberOf(shown(measure, value), decimalsOf(measure, value), minus);
    const std::string unit = measure.yesNo ? "%" : measure.unit;
    return unit.empty() ? number : number + ' ' + unit;
}

std::string differenceText(const ValidatedMeasure& measure, double value, const std::string& minus) {
    const std::string number = numberOf(shown(measure, value), decimalsOf(measure, value), minus);
    const std::string unit = measure.yesNo ? "points" : measure.unit;
    return (value > 0 ? "+" : "") + number + (unit.empty() ? "" : ' ' + unit);
}

std::string intervalText(const ValidatedMeasure& measure, const Estimate& estimate, const std::string& minus) {
    if (!std::isfinite(estimate.low)) return "not known";
    const int decimals = decimalsOf(measure, estimate.value);
    return numberOf(shown(measure, estimate.low), decimals, minus) + " to " +
           numberOf(shown(measure, estimate.high), decimals, minus);
}

std::string survivesText(const MeasureValidation& of, const std::string& minus) {
    if (!std::isfinite(of.survives.value)) return "not known: the gain in the simulator may be none";
    return numberOf(inPercent * of.survives.value, 0, minus) + " % (" +
           numberOf(inPercent * of.survives.low, 0, minus) + " to " + numberOf(inPercent * of.survives.high, 0, minus) +
           ')';
}

}  // namespace mrose
