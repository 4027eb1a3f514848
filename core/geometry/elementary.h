#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

// Elementary functions that give the same bits on every processor. The C library chooses its sine, exponential,
// logarithm and so on by processor at run time; these use only operations that IEEE 754 rounds exactly (+ - * / and the
// square root, the remainder), comparisons and bits, in a fixed order. What feeds the state, what is identified and
// what is learned is computed by them alone. Polynomials are own fits, summed in Estrin's order: short chains. Errors
// are relative, as tests/geometry/elementary_test.cpp measures them against long double.

namespace mrose {

/// The whole number nearest to x; |x| < 2^51.
inline double nearestWhole(double x) {
    constexpr double magic = 0x1.8p52;
    return (x + magic) - magic;
}

struct SineCosine {
    double sine, cosine;
};

namespace elementary {

/// An angle beyond 2^20 brought near 0: by the exact remainder of the rounded turn, then by what that turn lacks. From
/// 2^50 on, where doubles lie a sixth of a radian apart and more, the rounded turn alone.
inline double nearAngle(double radians) {
    constexpr double turn = 2 * std::numbers::pi, lacking = 2.4492935982947064e-16;
    const double rest = std::remainder(radians, turn);
    if (std::abs(radians) >= 0x1p50) return rest;
    return rest - nearestWhole((radians - rest) / turn) * lacking;
}

/// Exchanges a and b where `odd` is 1 and leaves them where it is 0, without a branch: which it is, no processor
/// guesses.
inline void exchange(std::uint64_t& a, std::uint64_t& b, std::uint64_t odd) {
    const std::uint64_t difference = (a ^ b) & (0 - odd);
    a ^= difference;
    b ^= difference;
}

/// 2^whole, for whole from -1022 to 1023.
inline double powerOfTwo(std::int64_t whole) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(whole + 1023) << 52);
}

/// exp(x) = 2^whole (1 + beyond), |x| <= 800.
struct Exponent {
    double whole, beyond;
    explicit Exponent(double x) : whole(nearestWhole(x * std::numbers::log2e)) {
        constexpr double high = 0x1.62e42fefp-1, low = 0x1.473de6af278edp-34;  // of log 2: whole * high is exact
        const double r = (x - whole * high) - whole * low, r2 = r * r, r4 = r2 * r2;
        // (exp(r) - 1 - r) / r^2
        const double a = (0.5 + 0.1666666666666667 * r) + r2 * (0.04166666666666667 + 0.008333333333326136 * r);
        const double b = (0.0013888888888883748 + 0.00019841269874820627 * r) +
                         r2 * (2.4801587325547743e-05 + 2.7557255400206422e-06 * r);
        const double c = (2.75572736431103e-07 + 2.5105217004720745e-08 * r) + r2 * 2.0914686968086876e-09;
        beyond = r + r2 * (a + r4 * (b + r4 * c));
    }
};

/// Of |y| up to pi/4 and a little.
inline SineCosine nearZero(double y) {
    const double z = y * y, z2 = z * z, z4 = z2 * z2, half = 0.5 * z;
    // (sin(y)/y - 1) / z and (cos(y) - 1 + z/2) / z^2
    const double s = ((-0.16666666666666632 + 0.008333333333322413 * z) +
                      z2 * (-0.0001984126982980749 + 2.755731369198108e-06 * z)) +
                     z4 * (-2.505075814911691e-08 + 1.5896798862290768e-10 * z);
    const double c = ((0.041666666666666595 + -0.0013888888888873474 * z) +
                      z2 * (2.480158728913144e-05 + -2.7557314262634994e-07 * z)) +
                     z4 * (2.0875712283705555e-09 + -1.1359127978294305e-11 * z);
    const double nearOne = 1 - half;
    return {y + y * z * s, nearOne + (((1 - nearOne) - half) + z2 * c)};
}

/// Of |radians| up to 2^20.
inline SineCosine byQuadrant(double radians) {
    // pi/2 in two parts (Cody and Waite): the product with the first is exact.
    constexpr double first = 0x1.921fb544p+0, second = 6.077100506506192e-11;
    const double quarters = nearestWhole(radians * (2 / std::numbers::pi));
    const SineCosine near = nearZero((radians - quarters * first) - quarters * second);
    auto sine = std::bit_cast<std::uint64_t>(near.sine), cosine = std::bit_cast<std::uint64_t>(near.cosine);
    const auto quadrant = static_cast<std::uint64_t>(static_cast<std::int64_t>(quarters));
    exchange(sine, cosine, quadrant & 1);
    sine ^= (quadrant & 2) << 62;
    cosine ^= ((quadrant + 1) & 2) << 62;
    return {std::bit_cast<double>(sine), std::bit_cast<double>(cosine)};
}

}  // namespace elementary

/// Error below 4e-16, or 1e-20 where that is more, up to |radians| = 2^20; of |radians| 2^-52 absolute, and less than
/// 3e-16 more, up to 2^50. Beyond, an angle says no more which way it points: both are then those of the remainder by
/// the double nearest to 2 pi. In [-1, 1]; NaN of what is not finite.
inline SineCosine sineCosine(double radians) {
    if (std::abs(radians) < 0.78)
        return elementary::nearZero(radians);  // what a robot turns in a tick: sooner, and the same
    if (!(std::abs(radians) < 0x1p20)) {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        if (!std::isfinite(radians)) return {none, none};
        radians = elementary::nearAngle(radians);
    }
    return elementary::byQuadrant(radians);
}

inline double sine(double radians) { return sineCosine(radians).sine; }
inline double cosine(double radians) { return sineCosine(radians).cosine; }
/// Error below 7e-16 where the sine's and cosine's are below 4e-16.
inline double tangent(double radians) {
    const auto [s, c] = sineCosine(radians);
    return s / c;
}

/// The angle of (x, y) in (-pi, pi], counter-clockwise from x; 0 for (0, 0) and of (x, -0) what it is of (x, 0), also
/// where x < 0. Infinite ones point along axes and diagonals. Error below 3e-16.
inline double arcTangent(double y, double x) {
    constexpr double pi = std::numbers::pi, tangentOfPi8 = 0.41421356237309503;
    double across = std::abs(y), along = std::abs(x);
    if (std::isnan(x) || std::isnan(y)) return x + y;
    if (std::isinf(std::max(across, along))) {
        across = std::isinf(across) ? 1 : 0;
        along = std::isinf(along) ? 1 : 0;
    }
    if (std::max(across, along) > 0x1p1000) across *= 0x1p-10, along *= 0x1p-10;  // their sum may overflow
    const double longer = std::max(across, along), shorter = std::min(across, along);
    if (longer == 0) return 0;
    const bool wide = shorter > tangentOfPi8 * longer;
    const double t = (wide ? shorter - longer : shorter) / (wide ? shorter + longer : longer);
    const double z = t * t, z2 = z * z, z4 = z2 * z2;
    // (atan(t)/t - 1) / z
    const double a =
        (-0.3333333333333319 + 0.19999999999951706 * z) + z2 * (-0.14285714280015635 + 0.11111110774834139 * z);
    const double b =
        (-0.09090897521145684 + 0.07692056197120324 * z) + z2 * (-0.06663060386101502 + 0.058475850899733506 * z);
    const double c = (-0.05037990156158396 + 0.03803248620839787 * z) + z2 * -0.017873433092412176;
    double angle = t + t * z * (a + z4 * (b + z4 * c));
    if (wide) angle += pi / 4;
    if (across > along) angle = pi / 2 - angle;
    if (x < 0) angle = pi - angle;
    return y < 0 ? -angle : angle;
}

/// NaN beyond [-1, 1]. Error below 6e-16.
inline double arcSine(double x) { return arcTangent(x, std::sqrt((1 - x) * (1 + x))); }
inline double arcCosine(double x) { return arcTangent(std::sqrt((1 - x) * (1 + x)), x); }

/// Error below 3e-16, where the result is a normal number; 0 and infinite beyond.
inline double exponential(double x) {
    if (!(std::abs(x) <= 800)) return x > 0 ? std::numeric_limits<double>::infinity() : x < 0 ? 0 : x;
    const elementary::Exponent e(x);
    const auto whole = static_cast<std::int64_t>(e.whole), half = whole / 2;
    return (1 + e.beyond) * elementary::powerOfTwo(half) * elementary::powerOfTwo(whole - half);
}

/// exp(x) - 1, without cancellation near 0. Error below 6e-16.
inline double exponentialMinusOne(double x) {
    if (!(std::abs(x) < 40)) return exponential(x) - 1;
    const elementary::Exponent e(x);
    const double scale = elementary::powerOfTwo(static_cast<std::int64_t>(e.whole));
    return scale * e.beyond + (scale - 1);
}

/// Natural; -infinity of 0, NaN below. Error below 3e-16.
inline double logarithm(double x) {
    constexpr double high = 0x1.62e42fefp-1, low = 0x1.473de6af278edp-34;  // of log 2
    constexpr std::uint64_t one = 0x3ff0000000000000, rootOfHalf = 0x3fe6a09e667f3bcd, fraction = 0x000fffffffffffff;
    if (!(x > 0)) return x == 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    if (std::isinf(x)) return x;
    double exponent = 0;
    if (x < std::numeric_limits<double>::min()) x *= 0x1p54, exponent = -54;
    // x = 2^exponent (1 + f), 1 + f from the root of a half to that of two
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(x) + (one - rootOfHalf);
    exponent += static_cast<double>(static_cast<std::int64_t>(bits >> 52) - 1023);
    const double f = std::bit_cast<double>((bits & fraction) + rootOfHalf) - 1, half = 0.5 * f * f;
    const double s = f / (2 + f), z = s * s, z2 = z * z;
    // (log((1 + s)/(1 - s)) - 2 s) / s
    const double a =
        (0.6666666666666734 + 0.3999999999941887 * z) + z2 * (0.28571428741474314 + 0.22222198664647302 * z);
    const double b = (0.18183559695772772 + 0.15314165850633674 * z) + z2 * 0.14794827261844107;
    const double r = z * (a + z2 * z2 * b);
    return exponent * high - ((half - (s * (half + r) + exponent * low)) - f);
}

/// x^y, as C has it but for the sign of zeros. Whole y up to 32: by products, error below 4e-15. Others by
/// exp(y log x): error below 3e-16 (2 + |y log x|).
inline double power(double x, double y) {
    if (std::abs(y) <= 32 && y == nearestWhole(y)) {
        double product = 1;
        for (int left = static_cast<int>(std::abs(y)); left > 0; left /= 2, x *= x)
            if (left % 2 == 1) product *= x;
        return y < 0 ? 1 / product : product;
    }
    if (x == 1 || (x == -1 && std::isinf(y))) return 1;
    if (!(x < 0)) return exponential(y * logarithm(x));
    const double size = exponential(y * logarithm(-x));
    if (std::trunc(y) != y) return std::isinf(x) ? size : std::numeric_limits<double>::quiet_NaN();
    return std::abs(std::fmod(y, 2)) == 1 ? -size : size;
}

/// Error below 6e-16.
inline double hyperbolicTangent(double x) {
    const double t = exponentialMinusOne(-2 * std::abs(x));
    return std::copysign(t / (2 + t), x);
}

// What the inputs of motion networks and the sensors are computed by: coarser and sooner than the above. Shipped
// networks predict the same bits as ever only if these stay as they are.

/// sin(2 pi turns), error below 1e-12 for |turns| < 2^40.
inline double sinTurns(double turns) {
    const double r = turns - nearestWhole(turns);
    const double folded = std::copysign(std::min(std::abs(r), 0.5 - std::abs(r)), r);
    const double u = folded * folded;
    double s = 3.6660599309377133;
    s = s * u + -15.081518474943021;
    s = s * u + 42.058137128025606;
    s = s * u + -76.70584760949875;
    s = s * u + 81.60524914986506;
    s = s * u + -41.341702239907534;
    s = s * u + 6.283185307179324;
    return s * folded;
}

inline double cosTurns(double turns) { return sinTurns(turns + 0.25); }

/// exp(-x) for x >= 0, relative error below 1e-13; 0 beyond 700.
inline double decay(double x) {
    const double scaled = std::min(x, 700.0) * -1.4426950408889634;
    const double whole = nearestWhole(scaled);
    const double f = scaled - whole;
    double p = 1.0224726667066698e-07;
    p = p * f + 1.3259978883874926e-06;
    p = p * f + 1.5252575073782608e-05;
    p = p * f + 0.00015403432294449333;
    p = p * f + 0.0013333558370042622;
    p = p * f + 0.009618129195883065;
    p = p * f + 0.05550410866356103;
    p = p * f + 0.24022650695632145;
    p = p * f + 0.6931471805599656;
    p = p * f + 1.0000000000000242;
    const auto exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(whole) + 1023) << 52;
    return x > 700.0 ? 0.0 : p * std::bit_cast<double>(exponent);
}

}  // namespace mrose
