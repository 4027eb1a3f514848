// Which decision a kick is traced back to, where learned delays let a later one be carried out first.
#include "debug/kick_cause.h"

#include <map>

#include <gtest/gtest.h>

#include "assessment/test_models.h"
#include "simulation/kicking_world.h"

namespace mrose {
namespace {

TEST(KickCause, IsTheOrderThatWasCarriedOut) {
    const auto often = std::make_shared<const HeldCommandModel>(20 * ms);
    int kicks = 0, overtaken = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        OpenedRun opened;
        opened.setup = std::make_shared<const BranchSetup>(
            BranchSetup{{}, std::make_shared<const Scenario>(kickingScenario(seed, 600 * ms, often))});
        opened.start = opened.setup->scenario->initialState();
        TimeTravel run(opened);
        std::map<Nanoseconds, std::int64_t> ordered;  // when kicks are due -> the tick that they were ordered in
        std::int64_t cause = -1, kicked = -1;
        while (run.tick() < 50) {
            const Nanoseconds readyBefore = run.state().robots[0].ready[0];
            ASSERT_TRUE(run.forward());
            for (const PendingKick& kick : run.state().kicks) ordered.emplace(kick.due, run.tick() - 1);
            if (const Nanoseconds ready = run.state().robots[0].ready[0]; ready != readyBefore) {
                const auto done = ordered.find(ready - 300 * ms);
                ASSERT_NE(done, ordered.end());
                cause = done->second;
                kicked = run.tick();
                ++kicks;
                for (const auto& [due, tick] : ordered) overtaken += tick < cause && due > done->first;
            }
            const auto found = causeOfKick(run);
            ASSERT_EQ(found.has_value(), kicked >= 0);
            if (!found) continue;
            EXPECT_EQ(found->order.tick, cause) << "seed " << seed << ", tick " << run.tick();
            EXPECT_EQ(found->kicked, kicked);
        }
    }
    EXPECT_GE(kicks, 100);
    EXPECT_GE(overtaken, 3) << "an order that is carried out before an earlier one";
}

}  // namespace
}  // namespace mrose
