// What ships goes on to the same bits from every tick, wherever and how often it is stepped.
#include <thread>

#include <gtest/gtest.h>

#include "simulation/shipped_crowd.h"
#include "simulation/small_world.h"
#include "support/shipped.h"
#include "support/test_data.h"
#include "world/state_bytes.h"
#include "world/state_difference.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

/// At every tick what was saved and restored steps to the same bits. How many contacts there were.
std::size_t expectSameBitsFromEveryTick(const Scenario& scenario, int ticks) {
    WorldState state = scenario.initialState();
    StepBuffers buffers, others;
    std::size_t contacts = 0;
    for (int k = 0; k < ticks; ++k) {
        const std::string saved = stateBytes(state);
        auto restored = parseState(saved, "saved");
        EXPECT_TRUE(restored);
        if (!restored) return contacts;
        step(scenario, state, buffers);
        step(scenario, *restored, others);
        const auto difference = firstDifference(state, *restored);
        EXPECT_FALSE(difference) << "tick " << k << ": " << difference->message();
        if (difference) return contacts;
        contacts += state.contacts.size();
    }
    return contacts;
}

TEST(ShippedRewind, AllRobotsAndControllersInACrowd) {
    EXPECT_GT(expectSameBitsFromEveryTick(shippedCrowd(true), 2000), 4000u);
}

TEST(ShippedRewind, Soccer) { EXPECT_GT(expectSameBitsFromEveryTick(shippedScenario("soccer"), 3000), 300u); }

TEST(ShippedRewind, Corridor) { EXPECT_GT(expectSameBitsFromEveryTick(shippedScenario("b21_corridor"), 6000), 5u); }

TEST(ShippedRewind, MrclamReplay) {
    if (!realData()) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    expectSameBitsFromEveryTick(shippedScenario("mrclam_replay"), 2000);
}

/// Hashes of 24 runs of 300 ticks, each with a seed of its own, on so many threads.
std::vector<StateHash> runOnThreads(const Scenario& scenario, std::size_t threads) {
    std::vector<StateHash> hashes(24);
    const auto work = [&](std::size_t first) {
        for (std::size_t i = first; i < hashes.size(); i += threads) {
            WorldState state = scenario.initialState(i + 1);
            run(scenario, state, 300);
            hashes[i] = hashOf(state);
        }
    };
    std::vector<std::thread> workers;
    for (std::size_t i = 1; i < threads; ++i) workers.emplace_back(work, i);
    work(0);
    for (std::thread& worker : workers) worker.join();
    return hashes;
}

TEST(ShippedRewind, OneThreadIsEightThreads) {
    for (const Scenario& scenario : {shippedCrowd(true), shippedScenario("soccer")}) {
        const std::vector<StateHash> one = runOnThreads(scenario, 1), eight = runOnThreads(scenario, 8);
        EXPECT_EQ(one, eight);
        EXPECT_FALSE(one[0] == one[1]) << "seeds matter";
    }
}

}  // namespace
}  // namespace mrose
