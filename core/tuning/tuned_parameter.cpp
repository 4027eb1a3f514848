#include "tuning/tuned_parameter.h"

#include <algorithm>
#include <cmath>

#include "geometry/elementary.h"

namespace mrose {
namespace {

constexpr double fineness = 1000;

/// To decimal places of which a unit is `step` at most.
double rounded(double value, double step) {
    double unit = 1;  // of the places behind the point its inverse, which is exact
    if (step >= 1) {
        while (10 * unit <= step) unit *= 10;
        return std::round(value / unit) * unit;
    }
    while (1 / unit > step) unit *= 10;
    return std::round(value * unit) / unit;
}

}  // namespace

double valueAt(const TunedParameter& p, double share) {
    share = std::clamp(share, 0.0, 1.0);
    // A whole number has as much of the way as the others.
    const double low = p.whole ? p.from - 0.5 : p.from, high = p.whole ? p.to + 0.5 : p.to;
    double value = low + share * (high - low);
    if (p.logarithmic) value = exponential(logarithm(low) + share * (logarithm(high) - logarithm(low)));
    if (p.whole) return std::clamp(std::round(value), p.from, p.to);
    if (p.from == p.to) return p.from;
    return std::clamp(rounded(value, (p.logarithmic ? value : p.to - p.from) / fineness), p.from, p.to);
}

double shareOf(const TunedParameter& p, double value) {
    const double low = p.whole ? p.from - 0.5 : p.from, high = p.whole ? p.to + 0.5 : p.to;
    if (!(high > low)) return 0;
    if (p.logarithmic) return (logarithm(value) - logarithm(low)) / (logarithm(high) - logarithm(low));
    return (value - low) / (high - low);
}

double leastStep(const TunedParameter& p) { return p.whole ? 1 / (p.to - p.from + 1) : 1 / fineness; }

}  // namespace mrose
