#include "world/state_bytes.h"

#include <gtest/gtest.h>

#include "world/arbitrary_state.h"
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

TEST(StateBytes, OtherVersionsAndFlagsAreErrors) {
    std::string bytes = stateBytes(arbitraryState(8));
    bytes[0] = 7;
    EXPECT_EQ(parseState(bytes, "a.mcap").error().message(), "a.mcap: holds a state of version 7; expected at most 2");

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
