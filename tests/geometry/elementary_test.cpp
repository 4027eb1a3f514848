// The elementary functions against those of the C library for long double, whose errors are below 2^-63.
#include "geometry/elementary.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/point.h"

namespace mrose {
namespace {

using std::numbers::pi;
constexpr double huge = std::numeric_limits<double>::infinity();

/// Numbers of both signs whose sizes lie evenly, by their logarithm, between two, and evenly in between.
std::vector<double> spread(double least, double most, int count = 200000) {
    std::mt19937_64 bits(7);
    const auto share = [&] { return static_cast<double>(bits() >> 11) * 0x1p-53; };
    std::vector<double> numbers;
    for (int i = 0; i < count; ++i) {
        const double size = i % 2 == 0 ? least * std::pow(most / least, share()) : least + (most - least) * share();
        numbers.push_back(i % 4 < 2 ? size : -size);
    }
    return numbers;
}

/// The largest error, relative to the reference but for what `slack` allows.
template <class Ours, class Reference>
double worstError(const std::vector<double>& arguments, Ours ours, Reference reference, long double slack = 0) {
    long double worst = 0;
    for (const double x : arguments) {
        const long double expected = reference(static_cast<long double>(x));
        const long double error = std::max(0.0L, std::abs(ours(x) - expected) - slack);
        if (error > 0) worst = std::max(worst, error / std::abs(expected));
    }
    return static_cast<double>(worst);
}

/// Fails where the bound is broken, and where it says far less than is true.
void expectError(const char* what, double worst, double bound) {
    EXPECT_LT(worst, bound) << what;
    EXPECT_GT(worst, bound / 4) << what << ": the bound is not what is reached";
}

TEST(Elementary, SineAndCosineAreExactToRounding) {
    std::vector<double> angles = spread(1e-300, 0x1p20);
    for (const double x : spread(1e-3, 10)) angles.push_back(x);
    for (int k = 1; k < 600000; k += 7) angles.push_back(k * (pi / 2));  // where one of them nearly vanishes
    expectError("sine",
                worstError(
                    angles, sine, [](long double x) { return std::sin(x); }, 1e-20L),
                4e-16);
    expectError("cosine",
                worstError(
                    angles, cosine, [](long double x) { return std::cos(x); }, 1e-20L),
                4e-16);
    const auto tan = [](long double x) { return std::tan(x); };
    expectError("tangent", worstError(spread(1e-300, 1000), tangent, tan), 7e-16);
}

TEST(Elementary, SineOfFarAnglesKeepsWhatTheAngleSays) {
    for (const double x : spread(0x1p19, 0x1p50)) {
        const auto [s, c] = sineCosine(x);
        const double bound = 3e-16 + std::abs(x) * 0x1p-52;
        ASSERT_NEAR(s, static_cast<double>(std::sin(static_cast<long double>(x))), bound) << x;
        ASSERT_NEAR(c, static_cast<double>(std::cos(static_cast<long double>(x))), bound) << x;
    }
    for (const double x : spread(0x1p50, 1e308)) {
        const auto [s, c] = sineCosine(x);
        ASSERT_NEAR(s * s + c * c, 1, 1e-15) << x;
        const auto [s2, c2] = sineCosine(std::remainder(x, 2 * pi));
        ASSERT_TRUE(s == s2 && c == c2) << x;
    }
    for (const double x : {huge, -huge, std::nan("")}) EXPECT_TRUE(std::isnan(sine(x)) && std::isnan(cosine(x)));
}

TEST(Elementary, SineAndCosineStayWithinOneAndAreOddAndEven) {
    EXPECT_EQ(sine(0), 0);
    EXPECT_EQ(cosine(0), 1);
    for (const double x : spread(1e-10, 1e18)) {
        const auto [s, c] = sineCosine(x);
        ASSERT_TRUE(std::abs(s) <= 1 && std::abs(c) <= 1) << x;
        ASSERT_EQ(sine(-x), -s) << x;
        ASSERT_EQ(cosine(-x), c) << x;
    }
    for (int k = -100000; k <= 100000; ++k) {
        ASSERT_LE(std::abs(cosine(k * pi)), 1) << k;
        ASSERT_LE(std::abs(sine((k + 0.5) * pi)), 1) << k;
    }
}

TEST(Elementary, ArcTangentIsExactToRoundingAllRound) {
    const std::vector<double> y = spread(1e-200, 1e200), x = spread(1e-3, 1e3);
    double worst = 0;
    for (std::size_t i = 0; i < y.size(); ++i)
        for (const double up : {y[i], x[i] * (1 + 1e-7 * x[(i + 1) % x.size()])}) {
            const long double expected = std::atan2(static_cast<long double>(up), static_cast<long double>(x[i]));
            worst = std::max(worst, static_cast<double>(std::abs((arcTangent(up, x[i]) - expected) / expected)));
        }
    expectError("arcTangent", worst, 3e-16);
    const std::vector<double> shares = spread(1e-300, 1);
    expectError("arcSine", worstError(shares, arcSine, [](long double v) { return std::asin(v); }), 6e-16);
    expectError("arcCosine", worstError(shares, arcCosine, [](long double v) { return std::acos(v); }), 6e-16);
    EXPECT_TRUE(std::isnan(arcSine(1.1)) && std::isnan(arcCosine(-1.1)));
    EXPECT_EQ(arcSine(-1), -pi / 2);
    EXPECT_EQ(arcCosine(-1), pi);
}

TEST(Elementary, DirectionsOfAxesDiagonalsAndExtremes) {
    EXPECT_EQ(direction({2, 0}), 0);
    EXPECT_EQ(direction({0, 3}), pi / 2);
    EXPECT_EQ(direction({0, -3}), -pi / 2);
    EXPECT_EQ(direction({-1, 0}), pi);
    EXPECT_EQ(direction({-1, -0.0}), pi);
    EXPECT_EQ(direction({0, 0}), 0);
    EXPECT_EQ(direction({1, 1e-300}), 1e-300);
    for (const double size : {5e-324, 1e-310, 1.0, 1.7e308, huge}) {
        EXPECT_EQ(direction({size, size}), pi / 4) << size;
        EXPECT_EQ(direction({-size, -size}), -3 * pi / 4) << size;
    }
    EXPECT_EQ(direction({huge, 1}), 0);
    EXPECT_EQ(direction({-1e308, huge}), pi / 2);
    EXPECT_NEAR(direction({1.7e308, 1.6e308}), std::atan2(1.6, 1.7), 1e-15);
    EXPECT_TRUE(std::isnan(arcTangent(std::nan(""), 1)) && std::isnan(arcTangent(1, std::nan(""))));
}

TEST(Elementary, ExponentialIsExactToRounding) {
    std::vector<double> x = spread(1e-20, 700);
    for (const double near : spread(1e-20, 1)) x.push_back(near);
    expectError("exponential", worstError(x, exponential, [](long double v) { return std::exp(v); }), 3e-16);
    const auto expm1 = [](long double v) { return std::expm1(v); };
    expectError("exponentialMinusOne", worstError(x, exponentialMinusOne, expm1), 6e-16);
    const auto tanh = [](long double v) { return std::tanh(v); };
    expectError("hyperbolicTangent", worstError(x, hyperbolicTangent, tanh), 6e-16);
}

TEST(Elementary, ExponentialEndsInZeroAndInfinity) {
    EXPECT_EQ(exponential(0), 1);
    EXPECT_EQ(exponential(710), huge);
    EXPECT_EQ(exponential(huge), huge);
    EXPECT_EQ(exponential(-746), 0);
    EXPECT_EQ(exponential(-huge), 0);
    EXPECT_LT(exponential(709.7), 1.7e308);
    for (const double x : {-708.0, -720.0, -740.0, -745.1})  // numbers too small to be normal
        EXPECT_NEAR(exponential(x), static_cast<double>(std::exp(static_cast<long double>(x))), 5e-324) << x;
    EXPECT_EQ(exponentialMinusOne(0), 0);
    EXPECT_EQ(exponentialMinusOne(-1000), -1);
    EXPECT_EQ(exponentialMinusOne(huge), huge);
    EXPECT_EQ(hyperbolicTangent(1000), 1);
    EXPECT_EQ(hyperbolicTangent(-huge), -1);
    for (const auto function : {exponential, exponentialMinusOne, hyperbolicTangent, logarithm})
        EXPECT_TRUE(std::isnan(function(std::nan(""))));
}

TEST(Elementary, LogarithmIsExactToRounding) {
    std::vector<double> x;
    for (const double number : spread(1e-323, 1e308)) x.push_back(std::abs(number));
    for (const double number : spread(0.3, 3)) x.push_back(std::abs(number));
    for (const double off : spread(1e-15, 1e-2)) x.push_back(1 + off);
    expectError("logarithm", worstError(x, logarithm, [](long double v) { return std::log(v); }), 3e-16);
    EXPECT_EQ(logarithm(1), 0);
    EXPECT_EQ(logarithm(0), -huge);
    EXPECT_EQ(logarithm(-0.0), -huge);
    EXPECT_EQ(logarithm(huge), huge);
    EXPECT_TRUE(std::isnan(logarithm(-1)));
}

TEST(Elementary, PowerIsAsExactAsItSays) {
    const std::vector<double> bases = spread(0.01, 100), exponents = spread(0.01, 100);
    double whole = 0, others = 0;
    for (std::size_t i = 0; i < bases.size(); ++i) {
        const double x = std::abs(bases[i]), n = std::trunc(exponents[i] * 0.32), y = exponents[i];
        whole = std::max(
            whole,
            std::abs(static_cast<double>(power(bases[i], n) / std::pow(static_cast<long double>(bases[i]), n) - 1)));
        const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(y));
        others =
            std::max(others, std::abs(static_cast<double>(power(x, y) / exact - 1)) / (2 + std::abs(y * std::log(x))));
    }
    expectError("whole powers", whole, 4e-15);
    expectError("other powers", others, 3e-16);
    EXPECT_EQ(power(2, 10), 1024);
    EXPECT_EQ(power(-3, 3), -27);
    EXPECT_EQ(power(2, -2), 0.25);
}

TEST(Elementary, PowerOfSpecialNumbersIsTheLibrarys) {
    const double numbers[] = {0, 0.5, 1, 2, 3, 33, 34, 1e300, huge, -0.5, -1, -2, -3, -33, -1e300, -huge, std::nan("")};
    for (const double x : numbers)
        for (const double y : numbers) {
            const double ours = power(x, y), expected = std::pow(x, y);
            if (std::isnan(expected))
                EXPECT_TRUE(std::isnan(ours)) << x << '^' << y << " = " << ours;
            else if (expected == 0 || std::isinf(expected))
                EXPECT_EQ(ours, expected) << x << '^' << y;
            else
                EXPECT_NEAR(ours / expected, 1, 1e-13) << x << '^' << y;
        }
}

TEST(Elementary, SineOfTurnsAgreesWithTheLibrary) {
    for (int i = -40000; i <= 40000; ++i) {
        const double turns = i * 1.2345e-4;
        EXPECT_NEAR(sinTurns(turns), std::sin(2 * pi * turns), 1e-12) << turns;
        EXPECT_NEAR(cosTurns(turns), std::cos(2 * pi * turns), 1e-12) << turns;
    }
}

TEST(Elementary, SineOfTurnsIsOddAndPeriodic) {
    EXPECT_EQ(sinTurns(0), 0);
    EXPECT_EQ(sinTurns(-0.3), -sinTurns(0.3));
    EXPECT_EQ(sinTurns(1048576.25), 1.0 * sinTurns(0.25));
}

TEST(Elementary, DecayAgreesWithTheLibrary) {
    for (int i = 0; i <= 70000; ++i) {
        const double x = i * 0.01;
        EXPECT_NEAR(decay(x) / std::exp(-x), 1, 2e-13) << x;
    }
    EXPECT_EQ(decay(1000), 0);
}

}  // namespace
}  // namespace mrose
