#include "assessment/reading_scores.h"

#include <algorithm>
#include <cmath>

#include "geometry/normal_distribution.h"

namespace mrose {
namespace {

using Component = ReadingDistribution::Component;

/// The standard deviation of a sum of what is independent.
double together(double a, double b) { return std::sqrt(a * a + b * b); }

/// P(|Z| < |x|) with the sign of x, of a standard normal Z.
double twoSided(double x) { return 2 * normalProbability(x) - 1; }

/// E|X| of X normal.
double meanSize(double mean, double spread) {
    const double x = mean / spread;
    return mean * twoSided(x) + 2 * spread * normalDensity(x);
}

/// An integral of that over the mean.
double meanSizeIntegral(double mean, double spread) {
    const double x = mean / spread;
    return 0.5 * (mean * mean + spread * spread) * twoSided(x) + mean * spread * normalDensity(x);
}

/// E|X - Y| of X normal and Y even within +-reach.
double meanDistanceToEven(double mean, double spread, double reach) {
    return (meanSizeIntegral(mean + reach, spread) - meanSizeIntegral(mean - reach, spread)) / (2 * reach);
}

double meanDistanceToEven(double from, double reach) {
    const double size = std::abs(from);
    return size < reach ? (from * from + reach * reach) / (2 * reach) : size;
}

}  // namespace

double rankedProbabilityScore(const ReadingDistribution& predicted, int dimension, double error) {
    const auto d = static_cast<std::size_t>(dimension);
    const double even = predicted.gross.share, reach = predicted.gross.reach[d];
    double toError = 0, apart = 0;
    for (const Component& a : predicted.components()) {
        const double share = (1 - even) * predicted.shareOf(a);
        toError += share * meanSize(a.mean[d] - error, a.spread[d]);
        for (const Component& b : predicted.components())
            apart += share * (1 - even) * predicted.shareOf(b) *
                     meanSize(a.mean[d] - b.mean[d], together(a.spread[d], b.spread[d]));
        if (even > 0) apart += 2 * share * even * meanDistanceToEven(a.mean[d], a.spread[d], reach);
    }
    if (even > 0) {
        toError += even * meanDistanceToEven(error, reach);
        apart += even * even * 2 * reach / 3;
    }
    return toError - 0.5 * apart;
}

double errorQuantile(const ReadingDistribution& predicted, int dimension, double share) {
    // between the quantiles of what is mixed
    const auto d = static_cast<std::size_t>(dimension);
    double low = INFINITY, high = -INFINITY;
    const auto include = [&](double quantile) {
        low = std::min(low, quantile);
        high = std::max(high, quantile);
    };
    const double normal = normalQuantile(share);
    for (const Component& component : predicted.components()) include(component.mean[d] + normal * component.spread[d]);
    if (predicted.gross.share > 0) include((2 * share - 1) * predicted.gross.reach[d]);
    while (high - low > 1e-7) {
        const double middle = 0.5 * (low + high);
        (predicted.probabilityBelow(dimension, middle) < share ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace mrose
