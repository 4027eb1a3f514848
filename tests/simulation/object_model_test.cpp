#include "scene/object_model.h"

#include <gtest/gtest.h>

#include "quantities/value_key.h"
#include "scenario/carry_over.h"
#include "scenario/saved_state.h"
#include "simulation/small_world.h"
#include "world/noise_channel.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

/// A puck on an air table that the wind of the tick drives, whatever the floor: by 1 m/s2 to +x or to -x.
class AirTable final : public ObjectModel {
public:
    ObjectState after(const ObjectInput& input) const override {
        const double gust = uniformNoise(input.noise) < 0.5 ? -1 : 1;
        ObjectState state = input.state;
        state.pose.x += input.duration * (state.velocity_W.x + gust * input.duration / 2);
        state.pose.y += input.duration * state.velocity_W.y;
        state.velocity_W.x += gust * input.duration;
        return state;
    }
};

ObjectType puck(double mass = 1) {
    ObjectType type = boxType(0.1, mass);
    type.surface = {0, 1};
    type.motion = std::make_shared<const AirTable>();
    return type;
}

TEST(ObjectModel, MovesItsBodiesWhateverTheOthersDo) {
    const Scenario scenario =
        SmallWorld().object(puck(), {0, 0, 0}, {0, 0.5, 0}).object(boxType(), {3, 0, 0}).scenario();
    WorldState state = scenario.initialState();
    ObjectState expected = state.objects[0];
    for (std::int64_t tick = 0; tick < 200; ++tick) {
        // Drawn by its seed, tick and body: it starts at rest in x, so that the model has been asked then too.
        const NoiseKey key{state.seed, tick, 0, channelOf(NoiseChannel::floorFriction)};
        const ObjectType& type = scenario.scene().typeOfObject(0);
        expected = type.motion->after({expected, type, scenario.scene().environment.floor, 0, 0.02, key});
        run(scenario, state, 1);
        ASSERT_EQ(state.objects[0].pose, expected.pose) << tick;
        ASSERT_EQ(state.objects[0].velocity_W, expected.velocity_W) << tick;
    }
    EXPECT_NEAR(state.objects[0].pose.y, 2, 1e-9);
    EXPECT_EQ(state.objects[1].pose, (Pose{3, 0, 0}));
}

/// Pucks of one mass that fly against each other exchange the velocities that they have in the tick's middle: the wind
/// has worked on each for half of the tick, and does for the other half.
TEST(ObjectModel, ActsBeforeAndAfterAContact) {
    const Scenario scenario =
        SmallWorld().object(puck(), {0, 0, 0}, {1, 0, 0}).object(puck(), {0.5, 0, 0}, {-1, 0, 0}).scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    WorldState before = state;
    while (state.tick < 60) {
        before = state;
        step(scenario, state, buffers, {}, &trace);
        if (trace.touchedObjects[0]) break;
    }
    ASSERT_TRUE(trace.touchedObjects[0] && trace.touchedObjects[1]);
    const auto gust = [&](std::uint32_t body) {
        return uniformNoise({state.seed, before.tick, body, channelOf(NoiseChannel::floorFriction)}) < 0.5 ? -1 : 1;
    };
    for (std::uint32_t i = 0; i < 2; ++i) {
        const double came = before.objects[1 - i].velocity_W.x + 0.01 * gust(1 - i);
        EXPECT_NEAR(state.objects[i].velocity_W.x, came + 0.01 * gust(i), 1e-3);
    }
}

/// Remembers for how long it has moved the body, and starts with a second.
class Odometer final : public ObjectModel {
public:
    struct Memory {
        double moved = 0, starts = 0;  // s
    };
    std::size_t memorySize() const override { return sizeof(Memory); }
    void start(std::span<std::byte> memory) const override { as<Memory>(memory) = {1, 1}; }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override {
        entries.add("moved", as<Memory>(memory).moved, "s");
    }
    ObjectState after(const ObjectInput& input) const override {
        as<Memory>(input.memory).moved += input.duration;
        return FloorMotion().after(input);
    }
};

/// A ball between two pucks in a narrow field, which are told apart by what they remember.
Scenario rememberingWorld(double ballAt = 1) {
    ObjectType ball = ballType(), other = puck();
    ball.motion = other.motion = std::make_shared<const Odometer>();
    ball.surface.restitution = 1;
    Environment field = walledField(3, 1);
    field.goals.push_back({"east", {{2.5, 0}, {3, 0}, {3, 1}, {2.5, 1}}});
    SmallWorld world(field);
    world.object(ball, {ballAt, 0.5, 0}, {1.5, 0.4, 0}).object(puck(), {2, 0.6, 0}).object(other, {0.4, 0.5, 0});
    return world.scenario();
}

double moved(const Scenario& scenario, const WorldState& state, std::size_t body) {
    return explained(*scenario.scene().typeOfObject(body).motion, scenario.motionMemory(state, body))[0].value;
}

TEST(ObjectModel, RemembersOnceWhateverTouchesItsBodies) {
    const Scenario scenario = rememberingWorld();
    WorldState state = scenario.initialState();
    EXPECT_TRUE(scenario.motionMemory(state, 1).empty()) << "that of the air table remembers nothing";
    StepBuffers buffers;
    StepTrace trace;
    int touched = 0;
    for (int tick = 1; tick <= 35; ++tick) {
        step(scenario, state, buffers, {}, &trace);
        touched += trace.touchedObjects[0];
        // A tick in two halves is as long as a whole one.
        ASSERT_NEAR(moved(scenario, state, 0), 1 + 0.02 * tick, 1e-12) << tick;
        ASSERT_NEAR(moved(scenario, state, 2), 1 + 0.02 * tick, 1e-12) << tick;
    }
    EXPECT_GT(touched, 0);
}

TEST(ObjectModel, IsExplainedInTheCatalogue) {
    const Scenario scenario = rememberingWorld();
    WorldState state = scenario.initialState();
    run(scenario, state, 7);
    const auto value = boundValue(scenario, {"motion", nameOfBody(scenario.scene(), 2), "moved", "s"});
    ASSERT_TRUE(value) << value.error().message();
    EXPECT_EQ(numberOf(value->value({&scenario, &state})), moved(scenario, state, 2));
}

TEST(ObjectModel, BeginsAnewWhereTheBallIsPutBack) {
    const Scenario scenario = rememberingWorld(2.2);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    do step(scenario, state, buffers, {}, &trace);
    while (trace.goals.empty() && state.tick < 100);
    ASSERT_FALSE(trace.goals.empty());
    EXPECT_EQ(moved(scenario, state, 0), 1);
    EXPECT_GT(moved(scenario, state, 2), 1);
}

TEST(ObjectModel, MemoryIsRewoundCarriedOverAndSaved) {
    const Scenario scenario = rememberingWorld(), again = rememberingWorld();
    WorldState state = scenario.initialState();
    run(scenario, state, 20);
    const WorldState kept = state;
    run(scenario, state, 30);
    WorldState rewound = kept;
    run(scenario, rewound, 30);
    EXPECT_EQ(stateBytes(rewound), stateBytes(state));
    EXPECT_EQ(stateBytes(carriedOver(scenario, state, again)), stateBytes(state));
    const auto read = parseSavedState(savedStateText(savedState(scenario, state)), "s.state");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(restored(*read, again, state.seed).motion, state.motion);
}

}  // namespace
}  // namespace mrose
