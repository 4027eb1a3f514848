#include "experiment/estimates.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/elementary.h"

namespace mrose {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double tail = 0.975;
constexpr std::size_t nearlyNormal = 10'000;
constexpr double normalQuantile = 1.959963984540054;

/// The probability of Student's distribution between -t and t, as a finite sum (Abramowitz and Stegun 26.7.3, 26.7.4).
double between(double t, std::size_t degrees) {
    const double n = static_cast<double>(degrees), c2 = n / (n + t * t), s = t / std::sqrt(n + t * t);
    double term = 1, sum = 0;
    if (degrees % 2 == 0) {
        for (std::size_t k = 0; k + 2 <= degrees; k += 2) {
            sum += term;
            term *= c2 * (static_cast<double>(k) + 1) / (static_cast<double>(k) + 2);
        }
        return s * sum;
    }
    for (std::size_t k = 1; k + 2 <= degrees; k += 2) {
        sum += term;
        term *= c2 * (static_cast<double>(k) + 1) / (static_cast<double>(k) + 2);
    }
    const double angle = arcTangent(t, std::sqrt(n));
    return 2 / std::numbers::pi * (angle + s * std::sqrt(c2) * sum);
}

double meanOnly(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// Sum of products of what two series differ by from their means, over n (n - 1): the means' covariance.
double covarianceOfMeans(std::span<const double> a, double meanA, std::span<const double> b, double meanB) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - meanA) * (b[i] - meanB);
    const auto n = static_cast<double>(a.size());
    return sum / (n * (n - 1));
}

}  // namespace

Estimate::Estimate() : value(unknown), low(unknown), high(unknown) {}

double studentQuantile(std::size_t degrees) {
    if (degrees == 0) return std::numeric_limits<double>::infinity();
    if (degrees > nearlyNormal) return normalQuantile;
    double low = 0, high = 13;  // that of one degree is 12.7
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (between(middle, degrees) < 2 * tail - 1 ? low : high) = middle;
    }
    return (low + high) / 2;
}

Estimate meanOf(std::span<const double> values) {
    if (values.empty()) return {};
    const double mean = meanOnly(values);
    if (values.size() < 2) return {mean, unknown, unknown};
    const double half = studentQuantile(values.size() - 1) * std::sqrt(covarianceOfMeans(values, mean, values, mean));
    return {mean, mean - half, mean + half};
}

Estimate wilsonShare(double share, double count) {
    if (!(count >= 1)) return {};
    const double z2 = normalQuantile * normalQuantile, scale = 1 + z2 / count;
    const double middle = (share + z2 / (2 * count)) / scale;
    const double half = normalQuantile / scale * std::sqrt(share * (1 - share) / count + z2 / (4 * count * count));
    return {share, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

double effectiveCount(std::span<const double> byTrial, double runs) {
    const auto trials = static_cast<double>(byTrial.size());
    if (trials < 2 || runs <= trials) return runs;
    const double share = meanOnly(byTrial);
    const double alone = share * (1 - share) / runs, together = covarianceOfMeans(byTrial, share, byTrial, share);
    return alone > 0 ? runs / std::max(1.0, together / alone) : runs;
}

Estimate ratioOfMeans(std::span<const double> numerators, std::span<const double> denominators) {
    assert(numerators.size() == denominators.size());
    if (numerators.size() < 2) return {};
    const double a = meanOnly(numerators), b = meanOnly(denominators);
    const double t = studentQuantile(numerators.size() - 1), q = t * t;
    const double va = covarianceOfMeans(numerators, a, numerators, a);
    const double vb = covarianceOfMeans(denominators, b, denominators, b);
    const double cab = covarianceOfMeans(numerators, a, denominators, b);
    const double lead = b * b - q * vb;
    if (!(lead > 0)) return {};
    const double half = a * b - q * cab, root = std::sqrt(std::max(0.0, half * half - lead * (a * a - q * va)));
    return {a / b, (half - root) / lead, (half + root) / lead};
}

}  // namespace mrose
