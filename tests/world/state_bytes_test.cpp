#include "world/state_bytes.h"

#include <gtest/gtest.h>

#include "world/arbitrary_state.h"
#include "world/second_state_version.h"
#include "world/state_difference.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

TEST(StateBytes, ComeBackToTheBit) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const WorldState state = arbitraryState(seed, seed % 5);
        const std::string bytes = stateBytes(state);
        const Expected<WorldState> back = parseState(bytes, "state");
        ASSERT_TRUE(back) << back.error().message();
        EXPECT_FALSE(firstDifference(state, *back)) << firstDifference(state, *back)->message();
        EXPECT_EQ(hashOf(*back), hashOf(state));
        EXPECT_EQ(stateBytes(*back), bytes);
    }
    ASSERT_TRUE(parseState(stateBytes(WorldState{}), "state"));
}

TEST(StateBytes, AppendAfterWhatIsThere) {
    std::string bytes = "before";
    appendStateBytes(arbitraryState(1), bytes);
    EXPECT_EQ(bytes, "before" + stateBytes(arbitraryState(1)));
}

TEST(StateBytes, OtherLengthsAreErrors) {
    const std::string bytes = stateBytes(arbitraryState(6));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const auto state = parseState(bytes.substr(0, size), "state");
        ASSERT_FALSE(state) << size;
        EXPECT_EQ(state.error().file, "state");
    }
    EXPECT_FALSE(parseState(bytes + 'x', "state"));
}

TEST(StateBytes, SizesThatNoMemoryHoldsAreErrorsBeforeAllocation) {
    const std::string bytes = stateBytes(arbitraryState(7));
    for (std::size_t array = 0; array < 11; ++array)
        for (std::uint64_t size : {~std::uint64_t{0}, std::uint64_t{1} << 61, std::uint64_t{0}, std::uint64_t{7}}) {
            // One more by 2^61 takes as many bytes, in 64 bits.
            if (size == 7)
                std::memcpy(&size, bytes.data() + 4 + 8 * array, sizeof size), size += std::uint64_t{1} << 61;
            std::string wrong = bytes;
            std::memcpy(wrong.data() + 4 + 8 * array, &size, sizeof size);
            const auto state = parseState(wrong, "state");
            ASSERT_FALSE(state) << array;
            EXPECT_NE(state.error().message().find("sizes do not fit"), std::string::npos);
        }
}

/// Bytes as version 2 had them, by its description: messages of 64 bytes, without where they were sent.
std::string secondVersionBytes(const WorldState& state) {
    WorldState without = state;
    without.messages.clear();
    without.touches.clear();
    std::string bytes = stateBytes(without);
    bytes.erase(4 + 8 * 11, 8);  // how many touches
    bytes[0] = 2;
    const std::uint64_t count = state.messages.size();
    std::memcpy(bytes.data() + 4 + 8 * 4, &count, sizeof count);
    std::string messages;
    const auto append = [&](const auto& number) {
        messages.append(reinterpret_cast<const char*>(&number), sizeof number);
    };
    for (const SentMessage& m : state.messages) {
        append(m.tick);
        for (const std::uint32_t part : {m.from, m.to, m.kind, m.size}) append(part);
        messages.append(reinterpret_cast<const char*>(m.bytes.data()), 64);
    }
    constexpr std::size_t perRobot = sizeof(RobotState) - 3;
    const std::size_t before =
        4 + 8 * 11 + 16 + state.robots.size() * perRobot + state.objects.size() * sizeof(ObjectState) +
        state.contacts.size() * sizeof(ContactImpulse) + state.kicks.size() * sizeof(PendingKick);
    return bytes.insert(before, messages);
}

TEST(StateBytes, OfVersion2CanBeRead) {
    WorldState state = arbitraryState(4);
    state.touches.clear();
    state.messages.resize(3);
    for (std::size_t i = 0; i < 3; ++i) {
        SentMessage& m = state.messages[i];
        m = {40, i / 2, static_cast<std::uint32_t>(1 + i % 2), 2, 7, 64, position(state.robots[1 + i % 2].pose), 0,
             0,  {}};
        std::fill_n(m.bytes.begin(), 64, std::byte{static_cast<unsigned char>(i + 1)});
    }
    const auto back = parseState(secondVersionBytes(state), "state");
    ASSERT_TRUE(back) << back.error().message();
    EXPECT_FALSE(firstDifference(state, *back)) << firstDifference(state, *back)->message();
    EXPECT_FALSE(parseState(secondVersionBytes(state) + 'x', "state"));
    // Without messages the hash is the one of then.
    EXPECT_NE(secondVersionHash(state).world, hashOf(state).world);
    EXPECT_EQ(secondVersionHash(state).memories, hashOf(state).memories);
    state.messages.clear();
    EXPECT_EQ(secondVersionHash(state), hashOf(state));
}

TEST(StateBytes, OtherVersionsAndFlagsAreErrors) {
    std::string bytes = stateBytes(arbitraryState(8));
    bytes[0] = 7;
    EXPECT_EQ(parseState(bytes, "a.mcap").error().message(), "a.mcap: holds a state of version 7; expected at most 3");

    WorldState state = arbitraryState(9, 1);
    state.robots[0].pushed = false;
    const std::string without = stateBytes(state);
    state.robots[0].pushed = true;
    std::string with = stateBytes(state);
    const auto flag = std::mismatch(with.begin(), with.end(), without.begin()).first;
    *flag = 2;
    EXPECT_NE(parseState(with, "state").error().message().find("flag"), std::string::npos);
}

}  // namespace
}  // namespace mrose
