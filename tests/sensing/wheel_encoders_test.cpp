#include "sensing/wheel_encoders.h"

#include <gtest/gtest.h>

#include "sensing/ranging.h"

namespace mrose {
namespace {

Scenario counting(const WheelEncoders::Options& options, const Command& command, const Pose& start = {}) {
    RobotType type = discRobot(0.2);
    type.sensors = {std::make_shared<const WheelEncoders>(SensorTraits{"wheels"}, options)};
    return SmallWorld().robot(type, start, std::make_shared<const Told>(command), ideal()).scenario();
}

struct Counted {
    WheelTicks ticks;
    Pose reckoned;
    Pose truth;  ///< from where it started
};

Counted counted(const Scenario& scenario, int ticks, std::uint64_t seed = 1) {
    WorldState state = scenario.initialState(seed);
    const Pose start = state.robots[0].pose;
    StepBuffers buffers;
    StepTrace trace;
    Counted last;
    for (int k = 0; k < ticks; ++k) {
        const Pose now = state.robots[0].pose;
        step(scenario, state, buffers, {}, &trace);
        if (!trace.robots[0].observed) continue;
        const Observation& seen = trace.robots[0].observation;
        last = {seen.records<WheelTicks>("wheels")[0], seen.records<Pose>("wheels.pose")[0], relative(start, now)};
    }
    return last;
}

TEST(WheelEncoders, CountWhatEachWheelTurns) {
    // Straight on: both alike. In place: opposite, half the track times the angle.
    const Counted straight = counted(counting({2000, 0.4, 0}, {0.5, 0}, {1, 2, 0.7}), 501);
    EXPECT_EQ(straight.ticks.left, static_cast<std::int64_t>(std::floor(straight.truth.x * 2000)));
    EXPECT_EQ(straight.ticks.right, straight.ticks.left);
    const Counted turning = counted(counting({2000, 0.4, 0}, {0, 1}), 501);
    EXPECT_NEAR(static_cast<double>(turning.ticks.right), 0.2 * turning.truth.heading * 2000, 1);
    EXPECT_NEAR(static_cast<double>(turning.ticks.left), -0.2 * turning.truth.heading * 2000, 1);
    // On an arc each wheel's way is that of its own circle.
    const Counted arc = counted(counting({2000, 0.4, 0}, {0.6, 0.3}), 501);
    EXPECT_NEAR(static_cast<double>(arc.ticks.right) / static_cast<double>(arc.ticks.left), (2 + 0.2) / (2 - 0.2),
                0.01);
}

TEST(WheelEncoders, ReckonWhereTheyAreUpToTheirTicks) {
    for (const double perMetre : {200.0, 100'000.0}) {
        const Counted at = counted(counting({perMetre, 0.4, 0}, {0.4, 0.35}, {-1, 3, 2}), 801);
        // Each wheel is never off by more than a tick; the heading by two over the track, the way by that much of it.
        const double tick = 1 / perMetre, turned = 2 * tick / 0.4;
        EXPECT_NEAR(at.reckoned.heading, at.truth.heading, turned + 1e-4);
        EXPECT_LT(distance(position(at.reckoned), position(at.truth)), 2 * tick + turned * 0.4 * 16 + 2e-3);
        EXPECT_GT(length(position(at.truth)), 0.2);
    }
}

/// A random walk: independent of how often one looks, its variance grows with the way.
TEST(WheelEncoders, SlipGrowsWithTheRootOfTheWay) {
    for (const int ticks : {126, 501}) {
        StandardNormals normals;
        for (std::uint64_t seed = 0; seed < 400; ++seed) {
            const Counted at = counted(counting({1e6, 0.4, 0.01}, {0.5, 0}), ticks, seed);
            const double spread = 0.01 * std::sqrt(at.truth.x);
            normals.add((static_cast<double>(at.ticks.left) / 1e6 - at.truth.x) / spread);
            normals.add((static_cast<double>(at.ticks.right) / 1e6 - at.truth.x) / spread);
        }
        normals.expectStandard("slip");
    }
}

TEST(WheelEncoders, RepeatTheirReadingsFromEveryTick) {
    const Scenario scenario = counting({500, 0.3, 0.02}, {0.4, 0.5});
    expectSameFromEveryTick(scenario, 60);
}

}  // namespace
}  // namespace mrose
