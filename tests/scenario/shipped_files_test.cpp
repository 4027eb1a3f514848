// The files that ship load, and mean what they say.
#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "scenario/scenario_file.h"
#include "simulation/step.h"
#include "support/places.h"
#include "support/test_data.h"

namespace mrose {
namespace {

DiskDescriptions disk(std::vector<std::filesystem::path> logs = {}) {
    return DiskDescriptions({sourceFolder(), std::move(logs), ""});
}

TEST(ShippedFiles, SoccerLoadsAndRuns) {
    DiskDescriptions source = disk();
    const auto loaded = loadScenario("soccer.toml", source);
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ(loaded->name, "mrose:resources/scenarios/soccer.toml");
    Scenario scenario(loaded->parts);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    for (int i = 0; i < 500; ++i) step(scenario, state, buffers);
    EXPECT_EQ(state.tick, 500);
}

TEST(ShippedFiles, CorridorLoads) {
    DiskDescriptions source = disk();
    const auto loaded = loadScenario("b21_corridor.toml", source);
    ASSERT_TRUE(loaded) << loaded.error().message();
}

TEST(ShippedFiles, ReplayLoadsWithItsLog) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs";
    DiskDescriptions source = disk({*data / "mrclam"});
    const auto loaded = loadScenario("mrclam_replay.toml", source);
    ASSERT_TRUE(loaded) << loaded.error().message();
    for (const SceneRobot& robot : loaded->parts.scene.robots)
        std::printf("%s %g %g %g %lld\n", robot.name.c_str(), robot.start.x, robot.start.y, robot.start.heading, (long long)robot.phase);
    for (auto& [n, t] : loaded->texts) std::printf("%s %zu\n", n.c_str(), t.size());
}

TEST(ShippedFiles, ReplayWithoutItsLogSaysWhatToDo) {
    DiskDescriptions source = disk();
    const auto loaded = loadScenario("mrclam_replay.toml", source);
    ASSERT_FALSE(loaded);
    std::puts(loaded.error().message().c_str());
}

}  // namespace
}  // namespace mrose
