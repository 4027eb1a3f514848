#include "simulation/touch_counter.h"

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
    TouchCounter counter(TouchCounter::apart / 4);
    EXPECT_EQ(after(counter, {}), Pairs{});
    EXPECT_EQ(after(counter, {{2, 1}, {1, 2}, {0, noBody}}), (Pairs{{0, noBody}, {1, 2}}));
    EXPECT_EQ(after(counter, {{1, 2}}), Pairs{}) << "they still do";
    EXPECT_EQ(after(counter, {{1, 2}, {0, 2}}), (Pairs{{0, 2}}));
    EXPECT_EQ(after(counter, {{0, noBody}}), Pairs{}) << "two ticks without are a bounce";
    for (int tick = 0; tick < 3; ++tick) EXPECT_EQ(after(counter, {}), Pairs{});
    EXPECT_EQ(after(counter, {{1, 2}, {0, noBody}}), (Pairs{{1, 2}})) << "four ticks are apart";
}

/// Whatever is in contact beside it, and however long.
TEST(TouchCounter, APairThatRattlesIsOneTouch) {
    TouchCounter counter(20'000'000);
    std::size_t begun = 0;
    for (int tick = 0; tick < 1000; ++tick) {
        Pairs touching;
        if (tick % 7 == 0) touching.push_back({3, 4});
        if (tick % 20 == 0) touching.push_back({1, noBody});
        begun += after(counter, touching).size();
    }
    EXPECT_EQ(begun, 1u + 50u) << "0.14 s and 0.4 s apart";
}

}  // namespace
}  // namespace mrose
