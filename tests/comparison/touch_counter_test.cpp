#include "experiment/touch_counter.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

using Pairs = std::vector<TouchCounter::Pair>;

/// What begins in a tick in which these pairs touch.
Pairs after(TouchCounter& counter, const Pairs& touching) {
    StepTrace trace;
    for (const auto& [a, b] : touching) {
        ContactReport report;
        report.bodyA = a;
        report.bodyB = b;
        trace.contacts.push_back(report);
    }
    const auto begun = counter.add(trace);
    return {begun.begin(), begun.end()};
}

TEST(TouchCounter, CountsATouchOnceUntilThePairWasApart) {
    TouchCounter counter;
    EXPECT_EQ(after(counter, {}), Pairs{});
    EXPECT_EQ(after(counter, {{2, 1}, {1, 2}, {0, noBody}}), (Pairs{{0, noBody}, {1, 2}}));
    EXPECT_EQ(after(counter, {{1, 2}}), Pairs{}) << "they still do";
    EXPECT_EQ(after(counter, {{1, 2}, {0, noBody}, {0, 2}}), (Pairs{{0, 2}, {0, noBody}}));
    EXPECT_EQ(after(counter, {}), Pairs{});
    EXPECT_EQ(after(counter, {{1, 2}}), (Pairs{{1, 2}}));
}

}  // namespace
}  // namespace mrose
