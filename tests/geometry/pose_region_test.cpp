#include "geometry/pose_region.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "world/noise.h"

namespace mrose {
namespace {

/// Normal about (1, -2, heading), turned by 30 degrees, 0.4 m along and 0.1 m across.
std::vector<Pose> regionSamples(std::size_t count, double heading = 0.3) {
    std::vector<Pose> samples;
    for (std::size_t k = 0; k < count; ++k) {
        const NoisePair draw = normalPair({k, 0, 0, 0});
        const double turn = 0.2 * normalNoise({k, 1, 0, 0});
        samples.push_back(Pose{1, -2, std::numbers::pi / 6} * Pose{0.4 * draw.first, 0.1 * draw.second, 0});
        samples.back().heading = heading + turn;
    }
    return samples;
}

TEST(PoseRegion, HoldsTheStatedShareOfSamples) {
    for (const std::size_t count : {1u, 10u, 64u, 1000u}) {
        const std::vector<Pose> samples = regionSamples(count);
        const Pose around{1, -2, 0.3};
        const PoseRegion region = regionOf(samples, around);
        for (std::size_t i = 0; i < regionShares.size(); ++i) {
            const auto share = static_cast<RegionShare>(i);
            const auto held = static_cast<std::int64_t>(std::ceil(regionShares[i] * static_cast<double>(count) - 1e-9));
            const PoseRegion::Extent& extent = region.of(share);
            const auto in = [&](auto is) { return std::count_if(samples.begin(), samples.end(), is); };
            // The outline's many corners, and not the radius that was chosen.
            const Polygon outline = region.outline(share, 3000);
            EXPECT_NEAR(in([&](const Pose& pose) { return contains(outline, position(pose)); }), held, 1) << count;
            EXPECT_EQ(in([&](const Pose& pose) { return region.contains(position(pose), share); }), held) << count;
            EXPECT_EQ(in([&](const Pose& pose) { return extent.x.contains(pose.x); }), held) << count;
            EXPECT_EQ(in([&](const Pose& pose) { return extent.y.contains(pose.y); }), held) << count;
            EXPECT_EQ(in([&](const Pose& pose) {
                          return extent.heading.low <= pose.heading + 1e-12 &&
                                 pose.heading - 1e-12 <= extent.heading.high;
                      }),
                      held);
            EXPECT_EQ(in([&](const Pose& pose) { return distance(position(pose), {1, -2}) <= extent.error; }), held);
            EXPECT_EQ(
                in([&](const Pose& pose) { return std::abs(wrapAngle(pose.heading - 0.3)) <= extent.headingError; }),
                held);
        }
    }
}

TEST(PoseRegion, IsTheEllipseOfANormalDistribution) {
    const PoseRegion region = regionOf(regionSamples(20000), {1, -2, 0.3});
    EXPECT_NEAR(region.centre.x, 1, 0.01);
    EXPECT_NEAR(region.centre.y, -2, 0.01);
    for (std::size_t i = 0; i < regionShares.size(); ++i) {
        const auto share = static_cast<RegionShare>(i);
        // Of two normal numbers the sum of squares is below -2 ln(1 - share) with that probability.
        const double radius = std::sqrt(-2 * std::log(1 - regionShares[i]));
        const auto [length, width] = region.semiAxes(share);
        EXPECT_NEAR(length / (0.4 * radius), 1, 0.03);
        EXPECT_NEAR(width / (0.1 * radius), 1, 0.03);
        const double quantile = i == 0 ? 0.67449 : 1.64485;
        EXPECT_NEAR(region.of(share).heading.high, 0.3 + 0.2 * quantile, 0.01);
        EXPECT_NEAR(region.of(share).heading.low, 0.3 - 0.2 * quantile, 0.01);
    }
    const Polygon outline = region.outline(RegionShare::most, 360);
    const auto farthest = std::max_element(outline.begin(), outline.end(), [&](const Point& a, const Point& b) {
        return distance(a, region.centre) < distance(b, region.centre);
    });
    const double along = direction(*farthest - region.centre);
    EXPECT_NEAR(std::abs(std::sin(along - std::numbers::pi / 6)), 0, 0.03);
    EXPECT_GT(signedArea(outline), 0);
}

TEST(PoseRegion, HeadingsAreHeldAcrossHalfATurn) {
    std::vector<Pose> samples = regionSamples(101, std::numbers::pi - 0.05);
    const PoseRegion whole = regionOf(samples, {1, -2, std::numbers::pi - 0.05});
    for (Pose& sample : samples) sample.heading = wrapAngle(sample.heading);
    const PoseRegion wrapped = regionOf(samples, {1, -2, std::numbers::pi - 0.05});
    EXPECT_NEAR(wrapped.of(RegionShare::most).heading.high, whole.of(RegionShare::most).heading.high, 1e-9);
    EXPECT_GT(wrapped.of(RegionShare::most).heading.high, std::numbers::pi);
    EXPECT_NEAR(wrapped.of(RegionShare::half).headingError, whole.of(RegionShare::half).headingError, 1e-9);
}

TEST(PoseRegion, SamplesAtOnePlaceHaveNoExtent) {
    const std::vector<Pose> samples(5, Pose{3, 4, 1});
    const PoseRegion region = regionOf(samples, samples.front());
    EXPECT_LT(region.semiAxes(RegionShare::most).first, 1e-5);
    EXPECT_TRUE(region.contains({3, 4}, RegionShare::half));
    EXPECT_FALSE(region.contains({3.01, 4}, RegionShare::most));
}

TEST(PoseRegion, SwathHoldsEveryEllipseAndWhatLiesBetween) {
    std::vector<PoseRegion> regions;
    for (int i = 0; i < 6; ++i) {
        std::vector<Pose> samples = regionSamples(50);
        for (Pose& sample : samples) sample = Pose{0.5 * i, 0.1 * i * i, 0.2 * i} * sample;
        regions.push_back(regionOf(samples, {}));
    }
    const std::vector<Polygon> swath = swathOf(regions, RegionShare::most);
    ASSERT_EQ(swath.size(), 5u);
    const auto holds = [&](const Point& point) {
        return std::any_of(swath.begin(), swath.end(), [&](const Polygon& piece) { return contains(piece, point); });
    };
    for (const Polygon& piece : swath) EXPECT_GT(signedArea(piece), 0);
    for (std::size_t i = 0; i < regions.size(); ++i) {
        for (const Point& corner : regions[i].outline(RegionShare::most))
            EXPECT_TRUE(holds(regions[i].centre + 0.999 * (corner - regions[i].centre))) << i;
        if (i > 0) {
            EXPECT_TRUE(holds(0.5 * (regions[i].centre + regions[i - 1].centre)));
        }
    }
    EXPECT_TRUE(swathOf({}, RegionShare::half).empty());
    EXPECT_EQ(swathOf(regions, RegionShare::half, 100).size(), 1u) << "to the last, whatever lies between";
}

}  // namespace
}  // namespace mrose
