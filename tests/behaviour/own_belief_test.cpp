#include "behaviour/own_belief.h"

#include <gtest/gtest.h>

#include "behaviour/small_field.h"
#include "support/observation_parts.h"

namespace mrose {
namespace {

/// Watches over a robot that drives in circles, and keeps its belief.
struct Believer final : Controller {
    struct Memory {
        MotionMemory motion;
        OwnBelief self;
    };
    std::size_t memorySize() const override { return sizeof(Memory); }
    void decide(const Observation& observation, std::span<std::byte> bytes, Decision& decision) const override {
        Memory& memory = as<Memory>(bytes);
        memory.motion.observe(observation);
        memory.self.update(observation, memory.motion);
        decision.command = Command{0.3, 0.4};
        memory.motion.issue(*decision.command);
    }
};

struct Errors {
    double believed = 0, measured = 0, worst = 0;
};

Errors errorsWith(const Perception& perception) {
    const Scenario scenario =
        SmallWorld()
            .robot(perceivingRobot(perception), {1, 2, 0.5}, std::make_shared<const Believer>(), lateDrive())
            .scenario();
    WorldState state = scenario.initialState(3);
    StepBuffers buffers;
    StepTrace trace;
    Errors errors;
    int count = 0;
    for (int tick = 0; tick < 20000; ++tick) {
        const Pose truth = state.robots[0].pose;
        step(scenario, state, buffers, {}, &trace);
        if (!trace.robots[0].observed || tick < 100) continue;
        const OwnBelief& self = as<Believer::Memory>(scenario.memoryOf(state, 0)).self;
        const double off = distance(position(self.pose), position(truth));
        ++count;
        errors.believed += off;
        errors.worst = std::max(errors.worst, off);
        errors.measured += distance(position(trace.robots[0].observation.self()), position(truth));
    }
    errors.believed /= count;
    errors.measured /= count;
    return errors;
}

TEST(OwnBelief, FollowsExactSensors) { EXPECT_LT(errorsWith({}).worst, 2e-3); }

TEST(OwnBelief, CarriesLateMeasurementsOnToNow) {
    Perception perception;
    perception.self.latency = 240'000'000;
    EXPECT_LT(errorsWith(perception).worst, 2e-3);
}

TEST(OwnBelief, IsNearerThanTheMeasurements) {
    const Errors errors = errorsWith(cameras());
    EXPECT_LT(errors.believed, 0.6 * errors.measured);
}

TEST(OwnBelief, RefusesJumpsOfSingleMeasurements) {
    Perception perception;
    perception.self.jump = 0.05;
    perception.self.jumpDistance = 5;
    EXPECT_LT(errorsWith(perception).worst, 0.15);
}

TEST(OwnBelief, BelievesWhatItMeasuresAgainAndAgain) {
    MotionMemory motion{};
    OwnBelief self{};
    ObservationParts observation;
    observation.localised = true;
    for (int i = 0; i < 20; ++i) {
        observation.time = observation.selfMeasured = i * 100'000'000LL;
        observation.self = i < 10 ? Pose{1, 1, 0} : Pose{4, 1, 2};  // somebody has carried it away
        motion.observe(observation);
        self.update(observation, motion);
        EXPECT_EQ(distance(position(self.pose), {1, 1}) < 0.01, i < 13) << i;
    }
    EXPECT_LT(distance(position(self.pose), {4, 1}), 1e-9);
}

TEST(OwnBelief, KnowsNothingBeforeTheFirstMeasurement) {
    MotionMemory motion{};
    OwnBelief self{};
    ObservationParts observation;
    observation.velocity = {1, 1};
    for (int i = 0; i < 5; ++i) {
        observation.time = i * 100'000'000LL;
        motion.observe(observation);
        self.update(observation, motion);
    }
    EXPECT_EQ(self.known, 0);
}

}  // namespace
}  // namespace mrose
