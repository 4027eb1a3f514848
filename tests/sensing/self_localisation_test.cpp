#include "sensing/self_localisation.h"

#include <map>

#include "sensing/perceiving.h"
#include "support/units.h"

namespace mrose {
namespace {

constexpr double period = 0.1;  // s
const Pose startPose{1, -2, 0.5};

Scenario scenarioOf(const SelfLocalisation& self) {
    Perception perception;
    perception.self = self;
    return SmallWorld().robot(perceiving(perception), startPose, still(), ideal()).scenario();
}

TEST(SelfLocalisation, WhiteNoiseHasTheStatedDeviations) {
    const Pose deviation{0.05, 0.12, 0.03};
    const Scenario scenario = scenarioOf({.noise = deviation});
    SensorWatch watch(scenario, 11);
    StandardNormals x, y, heading, xy, xHeading, successive;
    double last = 0;
    for (int i = 0; i < 20000; ++i) {
        const Pose self = watch.next().self();
        const double zx = (self.x - startPose.x) / deviation.x, zy = (self.y - startPose.y) / deviation.y;
        const double zh = (self.heading - startPose.heading) / deviation.heading;
        x.add(zx);
        y.add(zy);
        heading.add(zh);
        // What is uncorrelated has a sum of variance 2.
        xy.add((zx + zy) / std::sqrt(2));
        xHeading.add((zx + zh) / std::sqrt(2));
        successive.add((zx + last) / std::sqrt(2));
        last = zx;
    }
    x.expectStandard("x");
    y.expectStandard("y");
    heading.expectStandard("heading");
    xy.expectStandard("x and y");
    xHeading.expectStandard("x and heading");
    EXPECT_NEAR(successive.squares / successive.count, 1, sigmas * std::sqrt(3.0 / successive.count));
}

/// Of a first-order autoregressive process with correlation time tau, observed every T, it is the innovations
/// b(t + T) - a b(t), a = exp(-T / tau), that are independent, with the share 1 - a^2 of its variance.
TEST(SelfLocalisation, BiasIsAutoregressiveWithItsCorrelationTime) {
    const SelfLocalisation self{.bias = {0.1, 0.07, 0.02}, .biasTime = 1.5};
    const Scenario scenario = scenarioOf(self);
    SensorWatch watch(scenario, 12);
    const double kept = std::exp(-period / 1.5), added = std::sqrt(1 - kept * kept);
    StandardNormals x, y, heading, successive;
    Pose last = watch.next().self();
    double lastInnovation = 0;
    for (int i = 0; i < 100000; ++i) {
        const Pose now = watch.next().self();
        const auto innovation = [&](double before, double after, double truth, double deviation) {
            return ((after - truth) - kept * (before - truth)) / (added * deviation);
        };
        const double z = innovation(last.x, now.x, startPose.x, self.bias.x);
        x.add(z);
        y.add(innovation(last.y, now.y, startPose.y, self.bias.y));
        heading.add(innovation(last.heading, now.heading, startPose.heading, self.bias.heading));
        successive.add((z + lastInnovation) / std::sqrt(2));
        lastInnovation = z;
        last = now;
    }
    x.expectStandard("x");
    y.expectStandard("y");
    heading.expectStandard("heading");
    EXPECT_NEAR(successive.squares / successive.count, 1, sigmas * std::sqrt(3.0 / successive.count));
}

TEST(SelfLocalisation, BiasIsStationaryFromTheFirstMeasurementOn) {
    const SelfLocalisation self{.bias = {0.1, 0.07, 0.02}};
    const Scenario scenario = scenarioOf(self);
    StandardNormals first, third;
    for (std::uint64_t seed = 0; seed < 5000; ++seed) {
        SensorWatch watch(scenario, seed);
        first.add((watch.next().self().x - startPose.x) / self.bias.x);
        watch.next();
        third.add((watch.next().self().heading - startPose.heading) / self.bias.heading);
    }
    first.expectStandard("first");
    third.expectStandard("third");
}

TEST(SelfLocalisation, NoiseAndBiasAreIndependent) {
    const Scenario scenario = scenarioOf({.noise = {0.03, 0.03, 0.03}, .bias = {0.04, 0.04, 0.04}});
    StandardNormals x, y, heading;
    for (std::uint64_t seed = 0; seed < 5000; ++seed) {
        const Pose self = SensorWatch(scenario, seed).next().self();
        x.add((self.x - startPose.x) / 0.05);
        y.add((self.y - startPose.y) / 0.05);
        heading.add((self.heading - startPose.heading) / 0.05);
    }
    x.expectStandard("x");
    y.expectStandard("y");
    heading.expectStandard("heading");
}

TEST(SelfLocalisation, MeasurementIsOldByTheLatencyToTheTick) {
    Perception perception;
    perception.self.latency = 110 * ms;  // 5.5 ticks of 20 ms: 6
    const Scenario scenario =
        SmallWorld()
            .robot(perceiving(perception), startPose, std::make_shared<const Told>(Command{0.5, 1}), ideal(), 2)
            .scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    std::map<std::int64_t, Pose> truth;
    for (std::int64_t tick = -6; tick < 0; ++tick) truth[tick] = startPose;
    int observed = 0;
    for (std::int64_t tick = 0; tick < 60; ++tick) {
        truth[tick] = state.robots[0].pose;
        StepTrace trace;
        step(scenario, state, buffers, {}, &trace);
        if (!trace.robots[0].observed) continue;
        ++observed;
        const Observation& seen = trace.robots[0].observation;
        EXPECT_EQ(seen.self(), truth[tick - 6]) << tick;
        EXPECT_EQ(seen.selfMeasured(), (tick - 6) * 20 * ms);
        EXPECT_EQ(seen.time, tick * 20 * ms);
        EXPECT_TRUE(tick <= 10 || seen.self() != truth[tick - 5]);
    }
    EXPECT_EQ(observed, 12);
}

TEST(SelfLocalisation, AfterADropOutTheLastMeasurementStaysWithItsTime) {
    const Scenario scenario = scenarioOf({.noise = {0.1, 0.1, 0.1}, .dropOut = 0.3});
    SensorWatch watch(scenario, 13);
    Observation last;
    int dropped = 0, beforeFirst = 0;
    const int n = 10000;
    for (int i = 0; i < n; ++i) {
        const Observation now = watch.next();
        const bool fresh = now.localised() && now.selfMeasured() == now.time;
        dropped += fresh ? 0 : 1;
        beforeFirst += now.localised() ? 0 : 1;
        if (!fresh && now.localised()) {
            EXPECT_EQ(now.self(), last.self());
            EXPECT_EQ(now.selfMeasured(), last.selfMeasured());
        }
        last = now;
    }
    expectRate(dropped, n, 0.3);
    EXPECT_LT(beforeFirst, 15);
}

TEST(SelfLocalisation, WithoutAnyMeasurementItDoesNotKnowWhereItIs) {
    const Scenario scenario = scenarioOf({.dropOut = 1});
    SensorWatch watch(scenario, 14);
    for (int i = 0; i < 100; ++i) {
        const Observation& now = watch.next();
        EXPECT_FALSE(now.localised());
        EXPECT_EQ(now.self(), Pose{});
    }
}

TEST(SelfLocalisation, JumpsAreRareAndFar) {
    const Scenario scenario = scenarioOf({.dropOut = 0.3, .jump = 0.02, .jumpDistance = 0.5});
    SensorWatch watch(scenario, 15);
    StandardNormals x, y;
    int measured = 0;
    for (int i = 0; i < 80000; ++i) {
        const Observation& now = watch.next();
        if (!now.localised() || now.selfMeasured() != now.time) continue;
        ++measured;
        if (now.self() == startPose) continue;
        EXPECT_EQ(now.self().heading, startPose.heading);
        x.add((now.self().x - startPose.x) / 0.5);
        y.add((now.self().y - startPose.y) / 0.5);
    }
    expectRate(x.count, measured, 0.02);
    x.expectStandard("x");
    y.expectStandard("y");
}

}  // namespace
}  // namespace mrose
