#include "motion/ramped_command.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "world/noise.h"

namespace mrose {
namespace {

/// Ages newest first, from 0 to the oldest, and for each piece between them v; w is its opposite, twice as much.
struct Pieces {
    std::vector<double> ages;
    std::vector<double> commands;

    Pieces(std::vector<double> ages, const std::vector<double>& values) : ages(std::move(ages)) {
        for (const double value : values) add(value);
    }
    void add(double value) { commands.insert(commands.end(), {value, -2 * value}); }
    std::size_t size() const { return commands.size() / 2; }
    double at(double age) const {
        std::size_t piece = 0;
        while (piece + 1 < size() && ages[piece + 1] <= age) ++piece;
        return commands[2 * piece];
    }
    /// Which had reached the oldest piece's command.
    RampedCommand ramped(double accelerationV, double accelerationW = 0) const {
        const double v = commands[commands.size() - 2];
        return {ActuatorLimits{accelerationV, accelerationW}, ages, commands.data(), 2, {v, -2 * v}};
    }
};

TEST(RampedCommand, GoesEvenlyToWhereTheCommandJumps) {
    const Pieces jump({0, 0.5, 2}, {1, 0});
    RampedCommand followed = jump.ramped(4);  // there 0.25 s later, 0.25 s ago
    EXPECT_DOUBLE_EQ(followed.mean(0, 0.25).v, 1);
    EXPECT_DOUBLE_EQ(followed.mean(0.25, 0.5).v, 0.5);
    EXPECT_DOUBLE_EQ(followed.mean(0.375, 0.5).v, 0.25);
    EXPECT_DOUBLE_EQ(followed.mean(0.5, 2).v, 0);
    EXPECT_DOUBLE_EQ(followed.mean(0.3, 0.4).v, 0.6);
    EXPECT_DOUBLE_EQ(followed.mean(0, 2).v, 0.375 / 2);
}

TEST(RampedCommand, ChannelsHaveLimitsOfTheirOwn) {
    const Pieces jump({0, 0.5, 2}, {1, 0});
    const Command both = jump.ramped(4, 16).mean(0.25, 0.5);  // w is there 0.125 s later
    EXPECT_DOUBLE_EQ(both.v, 0.5);
    EXPECT_DOUBLE_EQ(both.w, -1.5);
    EXPECT_DOUBLE_EQ(jump.ramped(4, 0).mean(0.25, 0.75).w, -1);
    EXPECT_DOUBLE_EQ(jump.ramped(0, 8).mean(0.25, 0.75).v, 0.5);
    EXPECT_DOUBLE_EQ(jump.ramped(0, 8).mean(0.25, 0.5).w, -1);
}

TEST(RampedCommand, BeginsWhereItIsSaidTo) {
    const Pieces still({0, 1}, {0.5});
    RampedCommand followed(ActuatorLimits{1, 2}, still.ages, still.commands.data(), 2, {0.1, -0.6});
    EXPECT_NEAR(followed.mean(0.6, 1).v, 0.3, 1e-15);
    EXPECT_NEAR(followed.at(0.9).v, 0.2, 1e-15);
    EXPECT_NEAR(followed.at(0.9).w, -0.8, 1e-15);
    EXPECT_EQ(followed.at(0.3).v, 0.5);
    EXPECT_EQ(followed.at(0).w, -1);
}

TEST(RampedCommand, TurnsBackOnItsWay) {
    const Pieces there({0, 0.3, 0.5, 1}, {-1, 1, 0});
    RampedCommand followed = there.ramped(2);  // 0.4 where it turns back, -0.2 now
    EXPECT_NEAR(followed.mean(0.3, 0.5).v, 0.2, 1e-15);
    EXPECT_NEAR(followed.mean(0.1, 0.3).v, 0.2, 1e-15);
    EXPECT_NEAR(followed.mean(0, 0.1).v, -0.1, 1e-15);
    EXPECT_NEAR(followed.at(0.4).v, 0.2, 1e-15);
    EXPECT_NEAR(followed.at(0.3).v, 0.4, 1e-15);
    EXPECT_NEAR(followed.at(0.1).v, 0, 1e-15);
}

TEST(RampedCommand, IsWhatSmallStepsMakeOfRandomCommands) {
    constexpr double step = 2e-5;
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        Pieces random({0}, {});
        while (random.ages.back() < 3) {
            const auto i = static_cast<std::int64_t>(random.size());
            random.ages.push_back(random.ages.back() + 0.02 + 0.2 * uniformNoise({seed, i, 0, 0}));
            random.add(normalNoise({seed, i, 0, 1}));
        }
        const double acceleration = 1 + 9 * uniformNoise({seed, 0, 1, 0}), newest = 0.17, oldest = 0.93;
        double value = random.at(random.ages.back()), sum = 0;
        for (double age = random.ages.back() - step / 2; age > newest; age -= step) {
            value += std::clamp(random.at(age) - value, -acceleration * step, acceleration * step);
            if (age < oldest) sum += step * value;
        }
        RampedCommand followed = random.ramped(acceleration, 2 * acceleration);
        const Command mean = followed.mean(newest, oldest);
        EXPECT_NEAR(mean.v, sum / (oldest - newest), 5e-4) << seed;
        EXPECT_NEAR(mean.w, -2 * mean.v, 1e-12) << seed;
        // In whatever order parts are asked for.
        const double middle = 0.5 * (newest + oldest), older = followed.mean(middle, oldest).v;
        EXPECT_NEAR(0.5 * (followed.mean(newest, middle).v + older), mean.v, 1e-12) << seed;
    }
}

TEST(RampedCommand, IsTheCommandWhereTheDriveIsQuick) {
    const Pieces some({0, 0.1, 0.35, 0.4, 1}, {0.3, -0.7, 0.2, 0.2});
    const double mean = (0.1 * 0.3 - 0.25 * 0.7 + 0.05 * 0.2) / 0.4;
    const Command quick = some.ramped(1e9).mean(0, 0.4);
    EXPECT_NEAR(quick.v, mean, 1e-8);
    EXPECT_NEAR(quick.w, -2 * mean, 1e-15);
}

}  // namespace
}  // namespace mrose
