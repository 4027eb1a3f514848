// The scenarios that ship, as a new user tries them.
#include <set>

#include "support/game_folder.h"
#include "support/test_data.h"

namespace mrose {
namespace {

class ShippedScenarios : public GameFolder {
protected:
    /// Recorded, replayed, and decided again: the same hash, the same ticks.
    void expectReplays(const std::string& scenario, const std::string& seconds, int ticks,
                       const std::vector<std::string>& more = {}) {
        std::vector<std::string> words{"run",         scenario,  "--duration", seconds, "--record", path("run.mcap"),
                                       "--overwrite", "--quiet", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        const nlohmann::json run = told(runMrose(words));
        EXPECT_EQ(run["faults"], 0);
        EXPECT_EQ(run["end"], "duration");
        for (const char* flag : {"", "--decide"}) {
            std::vector<std::string> again{"replay", path("run.mcap"), "--quiet", "--json"};
            if (*flag != '\0') again.emplace_back(flag);
            const nlohmann::json replayed = told(runMrose(again));
            EXPECT_EQ(replayed["same"], true) << scenario << ' ' << flag;
            EXPECT_EQ(replayed["ticks"], ticks);
        }
    }
};

TEST_F(ShippedScenarios, SoccerIsRecordedAndReplayed) { expectReplays("soccer.toml", "30", 1500); }

TEST_F(ShippedScenarios, CorridorIsRecordedAndReplayed) { expectReplays("b21_corridor.toml", "60", 3000); }

TEST_F(ShippedScenarios, MrclamReplayIsRecordedAndReplayed) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    const auto log = *data / "mrclam" / "MRCLAM_Dataset6";
    if (!std::filesystem::exists(log)) GTEST_SKIP() << "no MRCLAM data set 6 there";
    expectReplays("mrclam_replay.toml", "20", 1000, {"--log", log.string()});
}

TEST_F(ShippedScenarios, MrclamReplayWithoutItsLogIsOneLine) {
    expectOneLine(runMrose({"run", "mrclam_replay.toml", "--log", path("none"), "--quiet"}), {"none"});
}

/// A thousand short games.
TEST_F(ShippedScenarios, SoccerIsTriedAThousandTimes) {
    const ProgramResult result =
        runMrose({"batch", "soccer.toml", "--trials", "1000", "--duration", "1", "--quiet", "-o", path("games")});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto rows = csvRows(read("games/results.csv"));
    ASSERT_EQ(rows.size(), 1000u);
    std::set<std::string> hashes;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(rows[i].at("trial"), std::to_string(i + 1));
        EXPECT_EQ(rows[i].at("time_s"), "1.0");
        EXPECT_EQ(rows[i].at("faults"), "0");
        hashes.insert(rows[i].at("world_hash"));
    }
    EXPECT_EQ(hashes.size(), 1000u) << "each is another one";
}

TEST_F(ShippedScenarios, OneThreadIsEightThreads) {
    for (const char* scenario : {"soccer.toml", "b21_corridor.toml"}) {
        std::string first;
        for (const char* threads : {"1", "8"}) {
            const std::string out = std::string(scenario) + threads;
            const ProgramResult result = runMrose({"batch", scenario, "--trials", "16", "--duration", "4", "--threads",
                                                   threads, "--quiet", "-o", path(out)});
            ASSERT_EQ(result.status, 0) << result.err;
            if (first.empty()) first = read(out + "/results.csv");
            EXPECT_GT(first.size(), 1000u);
            EXPECT_EQ(read(out + "/results.csv"), first) << scenario;
        }
    }
}

}  // namespace
}  // namespace mrose
