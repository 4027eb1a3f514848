#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/elementary.h"

// The standard normal distribution, the same on every processor.

namespace mrose {

inline double normalDensity(double x) {
    return exponential(-0.5 * x * x) * (std::numbers::inv_sqrtpi / std::numbers::sqrt2);
}

/// Density over the probability of more than x: by Laplace's continued fraction for the tail, by a series about 0 else.
/// Relative error below 1e-13 for any x >= -8; it goes to 0 below.
inline double normalHazard(double x) {
    constexpr double tail = 2.5, nothing = -38;
    if (x < nothing) return 0;
    if (x < tail) {
        // P(0 < X < x) = density(x) (x + x^3/3 + x^5/(3 5) + ...)
        double term = x, sum = x;
        for (int n = 3; std::abs(term) > 1e-17 * std::abs(sum); n += 2) sum += term *= x * x / n;
        const double density = normalDensity(x);
        return density / (0.5 - density * sum);
    }
    double fraction = x;
    for (int n = 50; n >= 1; --n) fraction = x + n / fraction;
    return fraction;
}

/// The probability of less than x.
inline double normalProbability(double x) {
    return x < 0 ? normalDensity(x) / normalHazard(-x) : 1 - normalDensity(x) / normalHazard(x);
}

/// The logarithm of that, far into the tail too.
inline double logNormalProbability(double x) {
    if (x > -1) return logarithm(normalProbability(x));
    return -0.5 * x * x - 0.5 * logarithm(2 * std::numbers::pi) - logarithm(normalHazard(-x));
}

/// The same with its slope, sooner; error below 1e-14 of the value, or 4e-15.
struct LogProbability {
    double value, slope;
};
inline LogProbability logProbabilityAndSlope(double x) {
    const double slope = normalHazard(-x);
    if (x > 8) return {-slope / x, slope};
    return {-0.5 * x * x - 0.5 * logarithm(2 * std::numbers::pi) - logarithm(slope), slope};
}

/// The x of which a share `p` is less; infinite for 0 and 1.
inline double normalQuantile(double p) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN(), end = std::numeric_limits<double>::infinity();
    if (!(p > 0 && p < 1)) return p == 0 ? -end : p == 1 ? end : none;
    if (p > 0.5) return -normalQuantile(1 - p);
    // Newton's method on the logarithm, which is concave: from the left it does not overshoot.
    double x = -std::sqrt(-2 * logarithm(p));
    for (int i = 0; i < 20; ++i) {
        const double step = (logarithm(p) - logNormalProbability(x)) / normalHazard(-x);
        x += step;
        if (std::abs(step) < 1e-14) break;
    }
    return x;
}

namespace drawing {

constexpr double central = 0.475;

// Own fits of rational functions to the quantile of p = 0.5 + q: about the middle, and in the tails.

inline double centralNormal(double q) {
    const double r = q * q, r2 = r * r;
    const double above = (2.5066283971241865 - 24.200486613375954 * r) +
                         r2 * ((78.35965585620424 - 92.35914660654079 * r) + r2 * 24.143488242886672);
    const double below =
        (1 - 10.701780956913947 * r) + r2 * ((40.164242106255394 - 60.49717074565414 * r) + r2 * 28.489263758740307);
    return q * above / below;
}

inline double tailNormal(double q) {
    const double t = std::sqrt(-2 * logarithm(0.5 - std::abs(q)));
    const double above = ((0.3939418944326165 * t + 1.76598954010181) * t - 0.4205071849111127) * t - 2.590973242550366;
    const double below = (0.3934777389744675 * t + 1.7921083463335556) * t + 1;
    return std::copysign(above / below, q);
}

}  // namespace drawing

/// The quantile at once, for drawing from uniform numbers p, 2^-33 to 1 - 2^-33. Relative error below 1e-7.
inline double drawnNormal(double p) {
    const double q = p - 0.5;
    return std::abs(q) <= drawing::central ? drawing::centralNormal(q) : drawing::tailNormal(q);
}

/// The same of several, sooner.
template <std::size_t count>
std::array<double, count> drawnNormals(const std::array<double, count>& p) {
    std::array<double, count> normals;
    for (std::size_t i = 0; i < count; ++i) normals[i] = drawing::centralNormal(p[i] - 0.5);
    for (std::size_t i = 0; i < count; ++i)
        if (std::abs(p[i] - 0.5) > drawing::central) normals[i] = drawing::tailNormal(p[i] - 0.5);
    return normals;
}

}  // namespace mrose
