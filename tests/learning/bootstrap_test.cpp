#include "learning/bootstrap.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "world/noise.h"

namespace mrose {
namespace {

TEST(BootstrapTest, IntervalOfAMeanIsThatOfTheNormalDistribution) {
    constexpr std::size_t count = 400;
    std::vector<double> values;
    double mean = 0, squares = 0;
    for (std::size_t i = 0; i < count; ++i) values.push_back(normalNoise({5, static_cast<std::int64_t>(i), 0, 0}));
    for (const double value : values) mean += value / count;
    for (const double value : values) squares += (value - mean) * (value - mean) / count;
    const Interval interval = bootstrapInterval(count, [&](std::span<const std::size_t> drawn) {
        double sum = 0;
        for (const std::size_t i : drawn) sum += values[i];
        return sum / static_cast<double>(drawn.size());
    });
    const double half = 1.96 * std::sqrt(squares / count);
    EXPECT_NEAR(interval.low, mean - half, 0.1 * half);
    EXPECT_NEAR(interval.high, mean + half, 0.1 * half);
}

}  // namespace
}  // namespace mrose
