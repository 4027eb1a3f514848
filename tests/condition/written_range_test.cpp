#include "condition/written_range.h"

#include <limits>

#include <gtest/gtest.h>

namespace mrose {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

void expectRange(const char* text, double least, double most) {
    const ValueRange range = writtenRange(text);
    EXPECT_EQ(range.least, least) << text;
    EXPECT_EQ(range.most, most) << text;
}

TEST(WrittenRange, IsThatOfTruthsAndNumbers) {
    for (const char* const truth :
         {"ball.x < 1", "1 + 1 >= time", "a == b and c ~= d", "not robot[1].touching", "true",
          "(ball.x > 0) == (a > b)", "(a or b > 1) == true", "robot['<'].x == 0", "not (a and b) or f(a, b) <= 3"})
        expectRange(truth, 0, 1);
    expectRange("ball.x < 1 and 100 or 0", 0, 100);
    expectRange("(ball.x < 1 and 100 or -2.5)", -2.5, 100);
    expectRange("a < b and 3", 0, 3);
    expectRange("(a and b) == c and 7 or 5", 0, 7);
    expectRange("12", 12, 12);
    for (const char* const counted : {"time", "goals.left", "goals[1]", "goals['left']", "a < b and time or 0"})
        expectRange(counted, 0, infinite);
}

TEST(WrittenRange, IsNotKnownOfAnythingElse) {
    for (const char* const text : {"ball.x",
                                   "-ball.x",
                                   "time - draw.branch_s",
                                   "-time",
                                   "goals.left - goals.right",
                                   "goals.left < 1 or goals.x.y",
                                   "(a < b and 1 or 0) + (b < c and 1 or 0)",
                                   "a < b and ball.x or 0",
                                   "1 << 4",
                                   "256 >> 2",
                                   "a ~ 1",
                                   "0x10",
                                   "1e999",
                                   "max(a < b, 3)",
                                   "a[b < c]",
                                   "(function() return 1 < 2 end)()",
                                   "draw.corner == 0 and measure.success or 0/0",
                                   "",
                                   "(",
                                   "and",
                                   "1 or"})
        expectRange(text, -infinite, infinite);
}

}  // namespace
}  // namespace mrose
