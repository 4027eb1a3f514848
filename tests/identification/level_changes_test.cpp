#include "identification/level_changes.h"

#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

/// Four misfits a second for `seconds`, of a level and of normal noise.
std::vector<StampedMisfit> misfits(double seconds, double noise, const std::function<double(double)>& level,
                                   std::uint64_t seed = 1) {
    std::vector<StampedMisfit> all;
    for (std::int64_t i = 0; i < std::llround(4 * seconds); ++i)
        all.push_back({i * 250 * ms, level(0.25 * static_cast<double>(i)) + noise * normalNoise({seed, i, 0, 0})});
    return all;
}

double block(double t, double begin, double end) { return t >= begin && t < end ? 1 : 0; }

TEST(LevelChanges, EachStretchIsFoundToTheReadingWhereNoiseIsSmall) {
    const auto found = levelChanges(
        misfits(200, 0.05, [](double t) { return 3 + block(t, 41.25, 60.5) - 2 * block(t, 60.5, 90); }), 3, 0.5, 100);
    ASSERT_THAT(found, SizeIs(2));
    EXPECT_EQ(found[0].begin, 41250 * ms);
    EXPECT_EQ(found[0].end, 60250 * ms);
    EXPECT_EQ(found[1].begin, 60500 * ms);
    EXPECT_EQ(found[1].end, 89750 * ms);
    EXPECT_NEAR(found[0].offset, 1, 0.1);
    EXPECT_NEAR(found[1].offset, -2, 0.1);
}

TEST(LevelChanges, OffsetsAreWithinTheirErrorsOfThoseThatArePlanted) {
    double squares = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const auto found = levelChanges(misfits(
                                            300, 0.3, [](double t) { return block(t, 100, 160); }, seed),
                                        0, 0.5, 100);
        ASSERT_THAT(found, SizeIs(1)) << seed;
        squares += std::pow((found[0].offset - 1) / found[0].error, 2);
    }
    EXPECT_GT(squares / 40, 0.4);
    EXPECT_LT(squares / 40, 2.5);
}

TEST(LevelChanges, NoiseAndSlowWanderAreNone) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        EXPECT_THAT(levelChanges(misfits(
                                     900, 1, [](double) { return 0; }, seed),
                                 0, 0.4, 100),
                    IsEmpty())
            << seed;
        EXPECT_THAT(levelChanges(misfits(
                                     900, 0.2, [](double t) { return 0.4 * std::sin(t / 20); }, seed),
                                 0, 0.5, 100),
                    IsEmpty())
            << seed;
    }
}

TEST(LevelChanges, ShortOnesAndWildMisfitsAreNone) {
    EXPECT_THAT(levelChanges(misfits(100, 0.05, [](double t) { return block(t, 50, 52); }), 0, 0.5, 100), IsEmpty());
    EXPECT_THAT(levelChanges(misfits(100, 0.05, [](double t) { return 9 * block(t, 50, 70); }), 0, 0.5, 5), IsEmpty());
    EXPECT_THAT(levelChanges({}, 0, 0.5, 5), IsEmpty());
}

TEST(LevelChanges, AcrossALongPauseNothingGoesOn) {
    auto all = misfits(200, 0.05, [](double t) { return block(t, 80, 120); });
    std::erase_if(all,
                  [](const StampedMisfit& misfit) { return misfit.time >= 90 * second && misfit.time < 110 * second; });
    const auto found = levelChanges(all, 0, 0.5, 100);
    ASSERT_THAT(found, SizeIs(2));
    EXPECT_EQ(found[0].end, 89750 * ms);
    EXPECT_EQ(found[1].begin, 110 * second);
}

}  // namespace
}  // namespace mrose
