// Robots that talk do the same in a batch, on any number of threads, and alone.
#include <sstream>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "experiment/batch.h"
#include "experiment/run.h"
#include "experiment/trial_world.h"
#include "io/file.h"
#include "scenario/variation.h"
#include "simulation/radio_world.h"
#include "support/temporary_folder.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

ScenarioParts talkingTrials() {
    ScenarioParts parts = trialWorld();
    for (auto& controller : parts.controllers)
        controller = std::make_shared<const Announcer>(3, 1, Command{0.5, 0}, true);
    parts.scene.radio = {.latency = 30'000'000, .jitter = 120'000'000, .loss = 0.3, .range = 2.5};
    return parts;
}

TEST(RadioBatch, RunsAreTheSameAloneAndInABatch) {
    const ScenarioParts parts = talkingTrials();
    const TemporaryFolder folder;
    BatchOptions options;
    options.trials = 4;
    options.lastSeed = 3;
    options.duration = 3 * nanosecondsPerSecond;
    std::string before;
    for (const std::size_t threads : {1, 2}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const std::filesystem::path place = folder.path() / std::to_string(threads);
        ASSERT_TRUE(runBatch(parts, options, place));
        const std::string results = readFile(place / "results.csv").value();
        EXPECT_TRUE(before.empty() || results == before);
        before = results;
    }
    std::set<std::uint64_t> worlds;
    for (std::uint32_t trial = 1; trial <= 4; ++trial)
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            const Scenario scenario(*varied(parts, trial));
            RunOptions alone;
            alone.duration = options.duration;
            const auto run = mrose::run(scenario, scenario.initialState(seed), alone);
            ASSERT_TRUE(run);
            std::ostringstream hash;
            hash << std::hex;
            hash.width(16);
            hash.fill('0');
            hash << hashOf(run->state).world;
            EXPECT_NE(before.find(hash.str()), std::string::npos) << trial << ' ' << seed << ' ' << hash.str();
            worlds.insert(hashOf(run->state).world);
        }
    EXPECT_EQ(worlds.size(), 12u);
}

}  // namespace
}  // namespace mrose
