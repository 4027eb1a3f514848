#include "report/validation_text.h"

#include <algorithm>
#include <cmath>

#include "io/format.h"

namespace mrose {
namespace {

constexpr double inPercent = 100;

double shown(const ValidatedMeasure& measure, double value) { return measure.yesNo ? inPercent * value : value; }

/// Two figures of the interval's half width; without an interval three of the value.
int decimalsOf(const ValidatedMeasure& measure, const Estimate& of) {
    if (measure.yesNo) return 1;
    const double width = 0.5 * (of.high - of.low);
    const bool known = std::isfinite(width) && width > 0;
    const double size = known ? width : std::abs(of.value);
    if (size == 0 || !std::isfinite(size)) return 2;
    return std::clamp((known ? 1 : 2) - static_cast<int>(std::floor(std::log10(size))), 0, 4);
}

std::string numberOf(double value, int decimals, const std::string& minus) {
    const std::string text = fixed(value, decimals);
    return text.starts_with('-') ? minus + text.substr(1) : text;
}

/// As it is written: whether it is 0, an end of its interval is, or 0 lies between these.
bool mayBeNone(const ValidatedMeasure& measure, const Estimate& gain) {
    const auto isNone = [&](double value) {
        return fixed(shown(measure, value), decimalsOf(measure, gain)).find_first_not_of("0.") == std::string::npos;
    };
    return isNone(gain.value) || isNone(gain.low) || isNone(gain.high) || (gain.low <= 0 && gain.high >= 0);
}

/// Of a difference.
std::string withUnit(const ValidatedMeasure& measure, const std::string& number) {
    const std::string unit = measure.yesNo ? "points" : measure.unit;
    return unit.empty() ? number : number + ' ' + unit;
}

}  // namespace

std::string measuredText(const ValidatedMeasure& measure, const Estimate& value, const std::string& minus) {
    const std::string number = numberOf(shown(measure, value.value), decimalsOf(measure, value), minus);
    const std::string unit = measure.yesNo ? "%" : measure.unit;
    return unit.empty() ? number : number + ' ' + unit;
}

std::string measuredText(const ValidatedMeasure& measure, double value, const std::string& minus) {
    Estimate alone;
    alone.value = value;
    return measuredText(measure, alone, minus);
}

std::string differenceText(const ValidatedMeasure& measure, const Estimate& value, const std::string& minus) {
    const std::string number = numberOf(shown(measure, value.value), decimalsOf(measure, value), minus);
    return (value.value > 0 ? "+" : "") + withUnit(measure, number);
}

std::string intervalText(const ValidatedMeasure& measure, const Estimate& estimate, const std::string& minus) {
    if (!std::isfinite(estimate.low)) return "not known";
    const int decimals = decimalsOf(measure, estimate);
    return numberOf(shown(measure, estimate.low), decimals, minus) + " to " +
           numberOf(shown(measure, estimate.high), decimals, minus);
}

constexpr const char* noDifference = "no difference shown";

std::string gainText(const ValidatedMeasure& measure, const Estimate& gain) {
    if (!std::isfinite(gain.value)) return "not known";
    if (mayBeNone(measure, gain)) return noDifference;
    const std::string number = fixed(std::abs(shown(measure, gain.value)), decimalsOf(measure, gain));
    return (gain.value < 0 ? "worse by " : "better by ") + withUnit(measure, number);
}

std::string gainWithIntervalText(const ValidatedMeasure& measure, const Estimate& gain, const std::string& minus) {
    const std::string text = gainText(measure, gain);
    if (text == noDifference)
        return text + " (" + differenceText(measure, gain, minus) + ", " + intervalText(measure, gain, minus) + ')';
    return text + " (" + intervalText(measure, gain.value < 0 ? negated(gain) : gain, minus) + ')';
}

std::string survivesText(const MeasureValidation& of, const std::string& minus) {
    if (!std::isfinite(of.survives.value)) return "not known: the gain in the simulator may be none";
    return numberOf(inPercent * of.survives.value, 0, minus) + " % (" +
           numberOf(inPercent * of.survives.low, 0, minus) + " to " + numberOf(inPercent * of.survives.high, 0, minus) +
           ')';
}

}  // namespace mrose
