#include "scene/object_model.h"

#include <gtest/gtest.h>

#include "simulation/small_world.h"
#include "world/noise_channel.h"

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

}  // namespace
}  // namespace mrose
