// Many robots find their messages without looking at all of them, and find all of them.
#include <random>

#include <gtest/gtest.h>

#include "simulation/radio_world.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

SmallWorld talkingCrowd(const Radio& radio, std::uint32_t robots, int teams) {
    SmallWorld world;
    std::mt19937_64 random(5);
    for (std::uint32_t i = 0; i < robots; ++i) {
        const auto column = static_cast<double>(i % 15), row = static_cast<double>(i / 15);
        const std::uint32_t to = static_cast<std::uint32_t>(random() % robots);
        world.robot(discRobot(0.2), {2 * column + 0.3 * static_cast<double>(random() % 4), 2 * row, 0},
                    announcer(static_cast<int>(random() % 3), to, {0.3, 0.4}),
                    everyTicks(2 + static_cast<int>(random() % 4)), static_cast<std::int64_t>(random() % 2));
        if (teams > 0) world.parts().scene.robots.back().team = std::to_string(random() % static_cast<unsigned>(teams));
    }
    world.parts().scene.radio = radio;
    return world;
}

TEST(RadioCrowd, HearsAllThatIsDueInRangeAndTeam) {
    for (const int teams : {0, 3})
        for (const double range : {0.0, 1.9, 4.5, 12.0, 100.0}) {
            const Scenario scenario = talkingCrowd({.latency = 45'000'000, .range = range}, 90, teams).scenario();
            const Heard heard = listen(scenario, 40);
            EXPECT_EQ(heard.at, expectedOf(scenario, heard, 40)) << teams << " teams, " << range << " m";
            EXPECT_GT(heard.at.size(), 100u);
        }
}

/// With a trace more is looked at, and nothing else comes of it.
TEST(RadioCrowd, GoesOnTheSameWhetherItIsTracedOrNot) {
    const Scenario scenario =
        talkingCrowd({.latency = 20'000'000, .jitter = 90'000'000, .loss = 0.3, .range = 5}, 90, 2).scenario();
    WorldState traced = scenario.initialState(), plain = traced;
    StepBuffers buffers, others;
    StepTrace trace;
    for (int k = 0; k < 60; ++k) {
        step(scenario, traced, buffers, {}, &trace);
        step(scenario, plain, others);
        ASSERT_EQ(hashOf(traced), hashOf(plain));
    }
}

}  // namespace
}  // namespace mrose
