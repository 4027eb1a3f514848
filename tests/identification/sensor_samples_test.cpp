#include "identification/sensor_samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "identification/sensor_summary.h"
#include "support/toy_camera.h"

namespace mrose {
namespace {

using testing::ElementsAre;

SensorSampleOptions toySampling() { return {.sensor = "camera", .latency = 40'000'000, .view = ToyCamera().view()}; }

TEST(SensorSampling, RobotsWithoutTheSensorAreNotAmongThoseToldApart) {
    const Log log = seenLog(ToyCamera(), 60);
    ASSERT_EQ(log.robots.size(), 2u);
    EXPECT_THAT(sensorSamples({&log, 1}, toySampling()).robots, ElementsAre("1"));
}

TEST(SensorSampling, SubjectsThatAreNotAskedForAreNoCases) {
    const Log log = seenLog(ToyCamera(), 60);
    SensorSampleOptions landmarks = toySampling(), robots = toySampling();
    landmarks.robotSubjects = robots.landmarks = false;
    const auto both = sensorSamples({&log, 1}, toySampling());
    const auto a = sensorSamples({&log, 1}, landmarks), b = sensorSamples({&log, 1}, robots);
    EXPECT_GT(a.cases.size(), 0u);
    EXPECT_GT(b.cases.size(), 0u);
    EXPECT_EQ(a.cases.size() + b.cases.size(), both.cases.size());
    for (const SensorCase& one : a.cases) EXPECT_EQ(one.state.subject, SubjectKind::landmark);
    for (const SensorCase& one : b.cases) EXPECT_EQ(one.state.subject, SubjectKind::robot);
}

TEST(SensorSampling, LooksOfAFalseTruthAreLeftOut) {
    const Log log = seenLog(ToyCamera(), 60);
    SensorSampleOptions options = toySampling();
    const auto all = sensorSamples({&log, 1}, options);
    const Nanoseconds begin = all.looks[10].time, end = all.looks[14].time;
    options.falseTruth = {{0, 0, 0, begin, end}, {0, 1, 0, 0, all.looks.back().time}, {1, 0, 0, 0, end}};
    const auto found = sensorSamples({&log, 1}, options);
    EXPECT_EQ(found.falseTruth, std::ranges::count_if(all.looks, [&](const SampledLook& look) {
                  return look.time >= begin && look.time <= end;
              }));
    for (const SampledLook& look : found.looks) EXPECT_TRUE(look.time < begin || look.time > end);
    EXPECT_EQ(found.looks.size() + static_cast<std::size_t>(found.falseTruth), all.looks.size());
}

TEST(SensorSummaries, LatencyIsAsUncertainAsRobotsDisagree) {
    const auto of = [](double lateness, double error) { return SensorLateness{true, {}, lateness, error}; };
    const std::vector<SensorLateness> alike{of(0.040, 0.002), of(0.040, 0.002)},
        apart{of(0.020, 0.002), of(0.060, 0.002)};
    EXPECT_NEAR(pooledLateness(alike).error, 0.002 / std::sqrt(2), 1e-12);
    EXPECT_NEAR(pooledLateness(apart).lateness, 0.040, 1e-12);
    EXPECT_NEAR(pooledLateness(apart).error, 0.020, 1e-12) << "half of how far they lie apart";
}

}  // namespace
}  // namespace mrose
