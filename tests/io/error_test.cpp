#include "io/error.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

TEST(Error, SaysWhatIsKnownAndLeavesOutTheRest) {
    EXPECT_EQ((Error{"a.csv", 3, 7, "t", "is text"}.message()), "a.csv:3:7: t: is text");
    EXPECT_EQ((Error{"a.csv", 3, 0, "t", "is text"}.message()), "a.csv:3: t: is text");
    EXPECT_EQ((Error{"a.csv", 0, 7, "", "is text"}.message()), "a.csv: is text");
    EXPECT_EQ((Error{"", 0, 0, "--seed", "is text"}.message()), "--seed: is text");
    EXPECT_EQ((Error{"", 0, 0, "", "is text"}.message()), "is text");
}

TEST(Error, StaysOneLineWhateverFilesHold) {
    EXPECT_EQ((Error{"a\nb", 1, 0, "k\r\x1b[2J", "is \"\t\x7f ä\""}.message()), "a?b:1: k??[2J: is \"?? ä\"");
}

TEST(Error, FailFillsTheMembers) {
    const Expected<int> result = fail("a.csv", "is text", 3, "t");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message(), "a.csv:3: t: is text");
}

}  // namespace
}  // namespace mrose
