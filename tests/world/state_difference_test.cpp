#include "world/state_difference.h"

#include <cmath>

#include <gtest/gtest.h>

#include "world/arbitrary_state.h"

namespace mrose {
namespace {

std::string differenceOf(const WorldState& a, const WorldState& b, StateScope scope = StateScope::all) {
    const auto difference = firstDifference(a, b, scope);
    return difference ? difference->message() : "";
}

TEST(StateDifference, SameStatesHaveNone) { EXPECT_EQ(differenceOf(arbitraryState(1), arbitraryState(1)), ""); }

TEST(StateDifference, NamesRobotAndField) {
    WorldState a = arbitraryState(2);
    a.robots[1].pose.x = 1.25;
    WorldState b = a;
    b.robots[1].pose.x = 1.2500001;
    b.objects[0].pose.x = 3;
    EXPECT_EQ(differenceOf(a, b), "robot 2 pose.x: 1.25 against 1.2500001");
    b = a;
    a.robots[2].segment.endRate.rotation = 0.0;
    b.robots[2].segment.endRate.rotation = -0.0;
    EXPECT_EQ(differenceOf(a, b), "robot 3 segment.endRate.rotation: 0.0 against -0.0");
    b = a;
    a.robots[0].ready[3] = 5;
    b.robots[0].ready[3] = 6;
    EXPECT_EQ(differenceOf(a, b), "robot 1 ready 4: 5 against 6");
    b = a;
    a.robots[0].pushed = true;
    b.robots[0].pushed = false;
    EXPECT_EQ(differenceOf(a, b), "robot 1 pushed: true against false");
}

TEST(StateDifference, NamesEveryOtherPart) {
    const WorldState a = arbitraryState(3);
    WorldState b = a;
    b.tick = a.tick ^ 1;
    EXPECT_EQ(differenceOf(a, b), "tick: " + std::to_string(a.tick) + " against " + std::to_string(b.tick));
    b = a;
    b.contacts[2].feature ^= 1;
    EXPECT_EQ(differenceOf(a, b).substr(0, 18), "contact 3 feature:");
    b = a;
    b.kicks[0].robot ^= 1;
    EXPECT_EQ(differenceOf(a, b).substr(0, 13), "kick 1 robot:");
    b = a;
    b.goals[1] ^= 1;
    EXPECT_EQ(differenceOf(a, b).substr(0, 7), "goal 2:");
    b = a;
    b.commands[6].time ^= 1;
    EXPECT_EQ(differenceOf(a, b).substr(0, 15), "command 7 time:");
    b = a;
    b.memory[16] ^= std::byte{1};
    EXPECT_EQ(differenceOf(a, b).substr(0, 29), "controllers' memory, byte 16:");
    b = a;
    b.past[9].y = 4;
    EXPECT_EQ(differenceOf(a, b).substr(0, 15), "past pose 10 y:");
    b = a;
    b.contacts.pop_back();
    EXPECT_EQ(differenceOf(a, b), "contacts: 5 against 4");
    b = a;
    b.memory.push_back({});
    EXPECT_EQ(differenceOf(a, b), "bytes of controllers: 33 against 34");
}

TEST(StateDifference, WorldLeavesMemoriesOut) {
    const WorldState a = arbitraryState(4);
    WorldState b = a;
    b.memory[0] ^= std::byte{1};
    EXPECT_TRUE(firstDifference(a, b)->ofMemories());
    b.past[0].x = 7;
    b.sensing[3] ^= std::byte{1};
    EXPECT_TRUE(firstDifference(a, b)->ofMemories());
    EXPECT_EQ(differenceOf(a, b, StateScope::world), "");
    b.motion[5] ^= std::byte{1};
    EXPECT_EQ(firstDifference(a, b, StateScope::world)->index, 5u);
    EXPECT_FALSE(firstDifference(a, b, StateScope::world)->ofMemories());
    b.robots[2].pose.y = 7;
    EXPECT_EQ(firstDifference(a, b, StateScope::world)->index, 2u);
    EXPECT_FALSE(firstDifference(a, b, StateScope::world)->ofMemories());
}

TEST(StateDifference, NansDifferByTheirBits) {
    WorldState a = arbitraryState(5);
    a.robots[0].pose.x = std::nan("1");
    WorldState b = a;
    EXPECT_EQ(differenceOf(a, b), "");
    b.robots[0].pose.x = std::nan("2");
    EXPECT_EQ(differenceOf(a, b), "robot 1 pose.x: nan:7ff8000000000001 against nan:7ff8000000000002");
}

}  // namespace
}  // namespace mrose
