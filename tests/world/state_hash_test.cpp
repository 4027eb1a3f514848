#include "world/state_hash.h"

#include <set>

#include <gtest/gtest.h>

#include "world/arbitrary_state.h"

namespace mrose {
namespace {

struct Changes {
    std::size_t bytes = 0, none = 0, world = 0, memories = 0, both = 0;
};

/// What the lowest bit of each byte that `value` lies in changes.
template <class Value>
Changes changesOf(WorldState& state, Value& value) {
    const StateHash before = hashOf(state);
    auto* bytes = reinterpret_cast<unsigned char*>(&value);
    Changes changes;
    for (std::size_t i = 0; i < sizeof value; ++i, ++changes.bytes) {
        bytes[i] ^= 1;
        const StateHash after = hashOf(state);
        bytes[i] ^= 1;
        const bool world = after.world != before.world, memories = after.memories != before.memories;
        ++(world && memories ? changes.both : world ? changes.world : memories ? changes.memories : changes.none);
    }
    return changes;
}

/// Every byte of these belongs to the world.
template <class Value>
void expectWorld(WorldState& state, Value& value) {
    EXPECT_EQ(changesOf(state, value).world, sizeof value);
}
template <class Value>
void expectMemories(WorldState& state, Value& value) {
    EXPECT_EQ(changesOf(state, value).memories, sizeof value);
}

TEST(StateHash, EveryByteOfARobotCountsOnceAndPaddingNever) {
    WorldState state = arbitraryState(1);
    // Three numbers and more, one count, one flag; by the declarations' own sizes.
    const std::size_t segment = sizeof(std::int64_t) + 5 * sizeof(Pose) + sizeof(Point) + sizeof(Velocity);
    const std::size_t world = sizeof(Pose) + sizeof(Twist) + 2 * sizeof(std::int64_t) + segment + sizeof(bool) +
                              sizeof(std::uint32_t) + sizeof(Command) + maxManipulators * sizeof(Nanoseconds);
    for (RobotState& robot : state.robots) {
        const Changes changes = changesOf(state, robot);
        EXPECT_EQ(changes.both, 0u);
        EXPECT_EQ(changes.world, world);
        EXPECT_EQ(changes.memories, 0u);
        EXPECT_EQ(changes.none, sizeof(RobotState) - world);
    }
}

TEST(StateHash, EveryByteOfEverythingElseCounts) {
    WorldState state = arbitraryState(2);
    expectWorld(state, state.tick);
    expectWorld(state, state.seed);
    for (ObjectState& object : state.objects) expectWorld(state, object);
    for (ContactImpulse& contact : state.contacts) expectWorld(state, contact);
    for (PendingKick& kick : state.kicks) expectWorld(state, kick);
    for (std::int32_t& goal : state.goals) expectWorld(state, goal);
    for (StampedCommand& command : state.commands) expectWorld(state, command);
    for (SentMessage& message : state.messages) expectWorld(state, message);
    for (std::byte& byte : state.motion) expectWorld(state, byte);
    for (std::byte& byte : state.memory) expectMemories(state, byte);
    for (std::byte& byte : state.sensing) expectMemories(state, byte);
    for (Pose& pose : state.past) expectMemories(state, pose);
    for (RobotTouch& touch : state.touches) expectMemories(state, touch);
}

TEST(StateHash, SignOfZeroCounts) {
    WorldState state = arbitraryState(3);
    state.robots[1].velocity_B.x = 0.0;
    const StateHash before = hashOf(state);
    state.robots[1].velocity_B.x = -0.0;
    EXPECT_NE(hashOf(state).world, before.world);
    EXPECT_EQ(hashOf(state).memories, before.memories);
}

TEST(StateHash, EqualStatesHaveEqualOnes) {
    EXPECT_EQ(hashOf(arbitraryState(4)), hashOf(arbitraryState(4)));
    EXPECT_NE(hashOf(arbitraryState(4)), hashOf(arbitraryState(5)));
}

/// Arrays that change their lengths at each other's cost do not look alike.
TEST(StateHash, LengthsCount) {
    std::set<std::uint64_t> worlds, memories;
    WorldState state;
    const auto add = [&] {
        worlds.insert(hashOf(state).world);
        memories.insert(hashOf(state).memories);
    };
    add();
    state.goals.resize(6);
    add();
    state.goals.clear();
    state.commands.resize(1);
    add();
    state.commands.clear();
    state.kicks.resize(1);
    add();
    EXPECT_EQ(worlds.size(), 4u);
    EXPECT_EQ(memories.size(), 1u);
    state.kicks.clear();
    state.memory.resize(24);
    add();
    state.memory.clear();
    state.past.resize(1);
    add();
    EXPECT_EQ(worlds.size(), 4u);
    EXPECT_EQ(memories.size(), 3u);
    state.past.clear();
    state.touches.resize(1);
    add();
    EXPECT_EQ(worlds.size(), 4u);
    EXPECT_EQ(memories.size(), 4u);
}

TEST(StateHash, ManyRobotsAllCount) {
    WorldState state = arbitraryState(5, 50);
    std::set<std::uint64_t> seen{hashOf(state).world};
    for (RobotState& robot : state.robots) {
        robot.pose.heading = robot.pose.heading == 0 ? 1 : 0;
        seen.insert(hashOf(state).world);
    }
    EXPECT_EQ(seen.size(), 51u);
}

}  // namespace
}  // namespace mrose
