#include "motion/ramped_command.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "world/noise.h"

namespace mrose {
namespace {

/// Ages newest first, from 0 to the oldest, and a command for each piece between them.
struct Commands {
    std::vector<double> ages, values;

    double at(double age) const {
        std::size_t piece = 0;
        while (piece + 1 < values.size() && ages[piece + 1] <= age) ++piece;
        return values[piece];
    }
    RampedCommand ramped(double acceleration) const { return ramped(acceleration, ages.back()); }
    RampedCommand ramped(double acceleration, double oldest) const {
        return {acceleration, ages, values.data(), 1, oldest};
    }
};

TEST(RampedCommand, GoesEvenlyToWhereTheCommandJumps) {
    const Commands jump{{0, 0.5, 2}, {1, 0}};
    RampedCommand followed = jump.ramped(4);  // there 0.25 s later, 0.25 s ago
    EXPECT_DOUBLE_EQ(followed.mean(0, 0.25), 1);
    EXPECT_DOUBLE_EQ(followed.mean(0.25, 0.5), 0.5);
    EXPECT_DOUBLE_EQ(followed.mean(0.375, 0.5), 0.25);
    EXPECT_DOUBLE_EQ(followed.mean(0.5, 2), 0);
    EXPECT_DOUBLE_EQ(followed.mean(0.3, 0.4), 0.6);
    EXPECT_DOUBLE_EQ(followed.mean(0, 2), 0.375 / 2);
}

TEST(RampedCommand, TurnsBackOnItsWay) {
    const Commands there{{0, 0.3, 0.5, 1}, {-1, 1, 0}};
    RampedCommand followed = there.ramped(2);  // 0.4 where it turns back, -0.2 now
    EXPECT_NEAR(followed.mean(0.3, 0.5), 0.2, 1e-15);
    EXPECT_NEAR(followed.mean(0.1, 0.3), 0.2, 1e-15);
    EXPECT_NEAR(followed.mean(0, 0.1), -0.1, 1e-15);
}

TEST(RampedCommand, IsWhatSmallStepsMakeOfRandomCommands) {
    constexpr double step = 2e-5;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        Commands commands{{0}, {}};
        while (commands.ages.back() < 3) {
            const auto i = static_cast<std::int64_t>(commands.values.size());
            commands.ages.push_back(commands.ages.back() + 0.02 + 0.2 * uniformNoise({seed, i, 0, 0}));
            commands.values.push_back(normalNoise({seed, i, 0, 1}));
        }
        const double acceleration = 1 + 9 * uniformNoise({seed, 0, 1, 0}), newest = 0.17, oldest = 0.93;
        double value = commands.values.back(), sum = 0;
        for (double age = commands.ages.back() - step / 2; age > newest; age -= step) {
            value += std::clamp(commands.at(age) - value, -acceleration * step, acceleration * step);
            if (age < oldest) sum += step * value;
        }
        RampedCommand followed = commands.ramped(acceleration, oldest);
        const double mean = followed.mean(newest, oldest);
        EXPECT_NEAR(mean, sum / (oldest - newest), 5e-4) << seed;
        // In whatever order parts are asked for.
        const double middle = 0.5 * (newest + oldest), older = followed.mean(middle, oldest);
        EXPECT_NEAR(0.5 * (followed.mean(newest, middle) + older), mean, 1e-12) << seed;
    }
}

TEST(RampedCommand, IsTheCommandWhereTheDriveIsQuick) {
    const Commands commands{{0, 0.1, 0.35, 0.4, 1}, {0.3, -0.7, 0.2, 0.2}};
    EXPECT_NEAR(commands.ramped(1e9).mean(0, 0.4), (0.1 * 0.3 - 0.25 * 0.7 + 0.05 * 0.2) / 0.4, 1e-8);
}

}  // namespace
}  // namespace mrose
