// Breakpoints that look through all rollouts of a log, and count in them. That the window opens what is found is in
// tests/gui.
#include <algorithm>

#include <gtest/gtest.h>

#include "debug/log_rollouts.h"
#include "support/places.h"
#include "workflow/open_log.h"

namespace mrose {
namespace {

/// Rollouts of 2 s of the shipped log; the first one is shown.
class RolloutBreaks : public testing::Test {
protected:
    void SetUp() override {
        const auto log = sourceFolder() / "resources" / "logs" / "pioneer" / "random.csv";
        auto opened = openLogAsRun({log.string()}, RolloutPlan{RolloutPlan::Cut::every, 0, 2});
        ASSERT_TRUE(opened) << opened.error().message();
        rollouts.replace(opened->world, opened->plan, opened->requests);
        rollouts.setShown(0);
        ASSERT_GE(rollouts.requests().size(), 8u);
    }
    RolloutFound found(const Breakpoint& breakpoint, const RolloutHits& hits = {}, bool back = false) const {
        const auto found =
            rolloutWithBreak(*rollouts.log(), rollouts.searchOthers({.back = back}, {breakpoint}, hits), {});
        EXPECT_TRUE(found) << found.error().message();
        return found.value_or(RolloutFound{});
    }
    /// The x of the simulated robot in each rollout as compare() has it, at its start and after each step.
    std::vector<std::vector<double>> ways() const {
        const auto compared = compareRollouts(*rollouts.log(), rollouts.requests(), rollouts.divergenceOptions(),
                                              [](const auto&, double) { return true; });
        EXPECT_TRUE(compared) << compared.error().message();
        std::vector<std::vector<double>> ways(rollouts.requests().size());
        for (const ComparedRollout& rollout : compared->rollouts) {
            if (rollout.use == RolloutUse::absent) continue;
            ways[rollout.request] = {rollout.real.truth.front().x};
            for (const Pose& pose : rollout.simulated) ways[rollout.request].push_back(pose.x);
        }
        return ways;
    }

    LogRollouts rollouts;
};

TEST_F(RolloutBreaks, AreFoundInTheNearestRolloutAheadAndBehind) {
    const std::vector<std::vector<double>> x = ways();
    const std::size_t last = x.size() - 1;
    double threshold = -1e9;  // that some rollout in the middle comes to exceed
    for (std::size_t rollout = 3; rollout < last - 2; ++rollout)
        threshold = std::max(threshold, (x[rollout].front() + x[rollout].back()) / 2);
    const Breakpoint beyond{.text = "robot[1].x > " + std::to_string(threshold)};
    const auto crosses = [&](std::size_t rollout) {
        const auto rises = [&](double before, double after) { return before <= threshold && after > threshold; };
        return std::adjacent_find(x[rollout].begin(), x[rollout].end(), rises) != x[rollout].end();
    };
    std::size_t ahead = 1, behind = last - 1;
    while (ahead < last && !crosses(ahead)) ++ahead;
    while (behind > 0 && !crosses(behind)) --behind;
    ASSERT_TRUE(crosses(ahead) && crosses(behind));
    EXPECT_EQ(found(beyond).rollout, ahead);
    rollouts.setShown(last);
    EXPECT_EQ(found(beyond, {}, true).rollout, behind);
    EXPECT_EQ(found(beyond).rollout, std::nullopt) << "none follows";
    EXPECT_EQ(found({.text = "robot[1].x > 1000"}, {}, true).rollout, std::nullopt);
}

TEST_F(RolloutBreaks, EachRolloutIsCountedOnce) {
    Breakpoint breakpoint{.text = "tick % 40 == 7"};
    const Nanoseconds tick = rollouts.world().parts().scene.tickLength;
    std::vector<std::int64_t> before{0};  // of each rollout: how often it is met in those before it, but for the first
    for (std::size_t i = 1; i < rollouts.requests().size(); ++i)
        before.push_back(before.back() + (rollouts.length(i) / tick + 33) / 40);
    breakpoint.from = 1000;
    RolloutHits hits;
    for (int i = 0; i < 2; ++i) {
        const RolloutFound none = found(breakpoint, hits);
        EXPECT_EQ(none.rollout, std::nullopt);
        hits = none.hits;
        EXPECT_EQ(hits.elsewhere(0).after[breakpoint.text], before.back());
        EXPECT_EQ(hits.elsewhere(3).before[breakpoint.text], before[2]);
    }
    breakpoint.from = static_cast<int>(before[2]) + 1;
    EXPECT_EQ(found(breakpoint).rollout, 3u);
}

TEST_F(RolloutBreaks, SearchIsEndedByItsProgress) {
    const RolloutSearch search = rollouts.searchOthers({}, {{.text = "robot[1].x > 1000"}}, {});
    int asked = 0;
    const auto ended = rolloutWithBreak(*rollouts.log(), search, [&](double) { return ++asked < 3; });
    ASSERT_TRUE(ended);
    EXPECT_EQ(ended->rollout, std::nullopt);
    EXPECT_EQ(asked, 3);
}

}  // namespace
}  // namespace mrose
