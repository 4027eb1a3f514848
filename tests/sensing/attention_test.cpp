// Controllers that do not read what is seen: they are not searched for, and nothing else changes.
#include <bit>

#include "behaviour/command_player.h"
#include "sensing/body_sight.h"
#include "sensing/perceiving.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

class Heedless final : public Controller {
public:
    explicit Heedless(const Attention& attention) : attention_(attention) {}
    Attention attention() const override { return attention_; }
    void decide(const Observation& observation, std::span<std::byte>, Decision& decision) const override {
        decision.command = Command{0.2, observation.self().heading > 0 ? -0.5 : 0.5};
    }

private:
    Attention attention_;
};

Perception biasedCamera() {
    Perception perception = cameraPerception(5);
    perception.objects.bearingBias = perception.robots.bearingBias = 0.03;
    return perception;
}

Scenario twoRobotsAndABall(const std::shared_ptr<const Controller>& controller) {
    return SmallWorld()
        .robot(perceiving(biasedCamera()), {0, 0, 0.1}, controller, ideal())
        .robot(perceiving(biasedCamera()), {2, 0.5, 3}, controller, ideal(), 2)
        .object(ballType(), {1, 0.6, 0})
        .scenario();
}

Scenario heeding(const Attention& attention) { return twoRobotsAndABall(std::make_shared<const Heedless>(attention)); }

TEST(Attention, WhatIsNotReadIsNotSeen) {
    for (const bool robots : {false, true})
        for (const bool objects : {false, true}) {
            Attention attention = Attention::ofItself();
            if (robots) attention.names.emplace_back(robotsReading);
            if (objects) attention.names.emplace_back(objectsReading);
            const Scenario scenario = heeding(attention), all = heeding({});
            SensorWatch watch(scenario, 3), attentive(all, 3);
            bool sawRobots = false, sawObjects = false;
            for (int i = 0; i < 20; ++i) {
                const Observation& expected = attentive.next();
                const Observation& seen = watch.next();
                sawRobots = sawRobots || !expected.robots().empty();
                sawObjects = sawObjects || !expected.objects().empty();
                for (const Reading& reading : expected.readings())
                    EXPECT_EQ(seen.find(reading.name) != nullptr, attention.reads(reading.name));
                EXPECT_EQ(seen.self(), expected.self());
                if (robots) {
                    EXPECT_TRUE(std::ranges::equal(seen.robots(), expected.robots())) << i;
                }
                if (objects) {
                    EXPECT_TRUE(std::ranges::equal(seen.objects(), expected.objects())) << i;
                }
            }
            EXPECT_TRUE(sawRobots && sawObjects);
        }
}

TEST(Attention, StateDoesNotDependOnIt) {
    const Scenario attentive = heeding({}), heedless = heeding(Attention::ofItself());
    WorldState one = attentive.initialState(5), other = heedless.initialState(5);
    StepBuffers buffers;
    for (int i = 0; i < 300; ++i) {
        step(attentive, one, buffers);
        step(heedless, other, buffers);
        ASSERT_EQ(hashOf(one), hashOf(other)) << i;
    }
    EXPECT_NE(as<BodySensor::Memory>(attentive.sensorMemory(one, 0, 1)).bearingBias, 0);
}

/// Who takes over in a branch perceives as if it had been there from the start.
TEST(Attention, ControllerThatLooksMayTakeOverAtAnyTime) {
    const Scenario attentive = heeding({}), heedless = heeding(Attention::ofItself());
    StepBuffers buffers;
    WorldState all = attentive.initialState(6), branch = heedless.initialState(6);
    for (int i = 0; i < 100; ++i) {
        step(attentive, all, buffers);
        step(heedless, branch, buffers);
    }
    int seen = 0;
    for (int i = 0; i < 100; ++i) {
        StepTrace expected, trace;
        step(attentive, all, buffers, {}, &expected);
        step(attentive, branch, buffers, {}, &trace);
        for (std::size_t robot = 0; robot < 2; ++robot) {
            if (!expected.robots[robot].observed) continue;
            EXPECT_EQ(trace.robots[robot].observation, expected.robots[robot].observation) << i;
            seen += static_cast<int>(expected.robots[robot].observation.objects().size());
        }
    }
    EXPECT_GT(seen, 0);
}

TEST(Attention, PlayersOfCommandsReadNothingOfOthers) {
    EXPECT_EQ(CommandPlayer({}).attention(), Attention::ofItself());
    const Attention reads = Attention::only({"camera.robots"});
    EXPECT_EQ(CommandPlayer({}, reads).attention(), reads) << "but what they are asked to";
}

}  // namespace
}  // namespace mrose
