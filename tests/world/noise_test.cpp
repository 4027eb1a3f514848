#include "world/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "geometry/normal_distribution.h"

namespace mrose {
namespace {

TEST(Noise, IsAFunctionOfItsKeyAlone) {
    const NoiseKey key{7, 12, 3, 1};
    const double first = normalNoise(key);
    normalNoise({7, 13, 3, 1});
    uniformNoise({1, 2, 3, 4});
    EXPECT_EQ(normalNoise(key), first);
}

TEST(Noise, EveryPartOfTheKeyMatters) {
    const std::set<double> draws{uniformNoise({1, 2, 3, 4}), uniformNoise({2, 2, 3, 4}), uniformNoise({1, 3, 3, 4}),
                                 uniformNoise({1, 2, 4, 4}), uniformNoise({1, 2, 3, 5})};
    EXPECT_EQ(draws.size(), 5u);
}

TEST(Noise, NormalDrawsHaveTheMomentsOfANormal) {
    const int n = 200000;
    double sum = 0, squares = 0, fourths = 0;
    for (int i = 0; i < n; ++i) {
        const double x = normalNoise({42, i, 0, 0});
        sum += x;
        squares += x * x;
        fourths += x * x * x * x;
    }
    EXPECT_NEAR(sum / n, 0, 4 / std::sqrt(n));
    EXPECT_NEAR(squares / n, 1, 4 * std::sqrt(2.0 / n));
    EXPECT_NEAR(fourths / n, 3, 4 * std::sqrt(96.0 / n));
}

TEST(Noise, NormalDrawsFillTheCellsOfANormalToItsTails) {
    constexpr int n = 2'000'000, cells = 82;  // 80 of 0.1, and beyond 4 to either side
    std::array<double, cells> counts{};
    double tail = 0, farTail = 0, products = 0, squares = 0;
    const auto add = [&](double x) {
        ++counts[static_cast<std::size_t>(std::clamp(std::floor(10 * x) + 41, 0.0, cells - 1.0))];
        tail += std::abs(x) > 3.66 ? 1 : 0;
        farTail += std::abs(x) > 4.2 ? 1 : 0;
    };
    for (int i = 0; i < n; ++i) {
        const NoisePair draw = normalPair({6, i, 1, 2});
        add(draw.first), add(draw.second);
        products += draw.first * draw.second;
        squares += draw.first * draw.first * draw.second * draw.second;
    }
    double chiSquared = 0;
    for (int cell = 0; cell < cells; ++cell) {
        const double low = cell == 0 ? 0 : normalProbability(0.1 * (cell - 41));
        const double high = cell == cells - 1 ? 1 : normalProbability(0.1 * (cell - 40));
        const double expected = 2 * n * (high - low);
        chiSquared += std::pow(counts[static_cast<std::size_t>(cell)] - expected, 2) / expected;
    }
    EXPECT_LT(chiSquared, 126.1);  // 99.9 % of chi squared with 81 degrees of freedom
    const auto expectCount = [&](double count, double beyond) {
        const double expected = 2 * n * 2 * (1 - normalProbability(beyond));
        EXPECT_NEAR(count, expected, 4.5 * std::sqrt(expected)) << beyond;
    };
    expectCount(tail, 3.66);
    expectCount(farTail, 4.2);
    EXPECT_NEAR(products / n, 0, 4.5 / std::sqrt(n)) << "independent";
    EXPECT_NEAR(squares / n, 1, 4.5 * std::sqrt(8.0 / n)) << "likewise";
}

TEST(Noise, PairsFirstIsTheNormalOfItsKey) {
    for (int i = 0; i < 10'000; ++i) {
        const NoiseKey key{6, i, 1, 2};
        ASSERT_EQ(normalPair(key).first, normalNoise(key));
    }
}

TEST(Noise, UniformDrawsFillTheUnitIntervalEvenly) {
    const int n = 100000, cells = 20;
    int counts[cells] = {};
    for (int i = 0; i < n; ++i) ++counts[static_cast<int>(cells * uniformNoise({9, i, 5, 2}))];
    double chiSquared = 0;
    for (const int count : counts) chiSquared += std::pow(count - n / cells, 2) / (n / cells);
    EXPECT_LT(chiSquared, 43.8);  // 99.9 % of chi squared with 19 degrees of freedom
}

TEST(Noise, EightDrawsOfAKeyAreItsBitsInOrder) {
    const NoiseKey key{3, 4, 5, 6};
    const auto words = noiseWords(key);
    EXPECT_EQ(words[0], noiseBits(key));
    const UniformDraws draws(key);
    std::set<double> all;
    for (std::size_t i = 0; i < 8; ++i) {
        const double bits = static_cast<double>(i % 2 == 0 ? words[i / 2] & 0xffffffff : words[i / 2] >> 32);
        EXPECT_EQ(draws[i], (bits + 0.5) / 4294967296.0);
        all.insert(draws[i]);
    }
    EXPECT_EQ(all.size(), 8u);
}

TEST(Noise, NormalsDrawnFromThemAreNormalAndIndependent) {
    const int n = 100000;
    std::array<double, 8> sum{}, squares{};
    std::array<double, 8> products{};  // with the next one
    std::array<int, 4> beyond{};       // 0, 1, 2, 3
    for (int i = 0; i < n; ++i) {
        const UniformDraws draws({77, i, 0, 0});
        for (std::size_t k = 0; k < 8; ++k) {
            const double x = drawnNormal(draws[k]);
            sum[k] += x;
            squares[k] += x * x;
            products[k] += x * drawnNormal(draws[(k + 1) % 8]);
            for (std::size_t limit = 0; limit < 4; ++limit) beyond[limit] += x > static_cast<double>(limit);
        }
    }
    for (std::size_t k = 0; k < 8; ++k) {
        EXPECT_NEAR(sum[k] / n, 0, 4.5 / std::sqrt(n)) << k;
        EXPECT_NEAR(squares[k] / n, 1, 4.5 * std::sqrt(2.0 / n)) << k;
        EXPECT_NEAR(products[k] / n, 0, 4.5 / std::sqrt(n)) << k;
    }
    for (std::size_t limit = 0; limit < 4; ++limit) {
        const double p = 1 - normalProbability(static_cast<double>(limit)), all = 8 * n;
        EXPECT_NEAR(beyond[limit] / all, p, 4.5 * std::sqrt(p / all)) << limit;
    }
}

TEST(Noise, UniformDrawsAreNeitherZeroNorOne) {
    for (const std::uint64_t word : {std::uint64_t{0}, ~std::uint64_t{0}, ~std::uint64_t{0} << 11}) {
        EXPECT_GT(openUnit(word), 0);
        EXPECT_LT(openUnit(word), 1);
    }
    // So one of n things is drawn by it, and never one behind them.
    for (std::size_t n = 1; n < 100'000; n += n < 1000 ? 1 : 997)
        EXPECT_LT(static_cast<std::size_t>(openUnit(~std::uint64_t{0}) * static_cast<double>(n)), n) << n;
}

TEST(Noise, AllDrawsButTheLastAreTheCentresOfTheirCells) {
    const auto centre = [](std::uint64_t cell) { return (static_cast<double>(cell) + 0.5) * 0x1p-53; };
    constexpr std::uint64_t last = (std::uint64_t{1} << 53) - 1;
    for (std::uint64_t i = 0; i < 1000; ++i)
        for (const std::uint64_t cell : {i, last / 1000 * i, last - 1 - i})
            EXPECT_EQ(openUnit(cell << 11), centre(cell)) << cell;
    for (std::int64_t i = 0; i < 1000; ++i) {
        const NoiseKey key{3, i, 1, 2};
        EXPECT_EQ(uniformNoise(key), centre(noiseBits(key) >> 11));
        EXPECT_EQ(uniformPair(key).first, uniformNoise(key));
    }
}

}  // namespace
}  // namespace mrose
