#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace mrose {

// Inference must give the same bits on every processor, and the C library chooses its sine and exponential by
// processor. These use only operations that IEEE 754 rounds exactly, in a fixed order.

/// The whole number nearest to x; |x| < 2^51.
inline double nearestWhole(double x) {
    constexpr double magic = 0x1.8p52;
    return (x + magic) - magic;
}

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
