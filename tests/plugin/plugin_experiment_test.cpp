// Experiments whose robots are driven by plug-ins.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiment/results_table.h"
#include "plugin/test_plugins.h"
#include "support/workshop.h"

namespace mrose {
namespace {

using testing::HasSubstr;

class PluginExperiment : public Workshop {
protected:
    /// Eight trials with two options each of a plug-in, one of which is drawn.
    std::string experiment(const std::string& plugin, const std::string& draw, const std::string& more) {
        write("lane.toml",
              "format = \"mrose scenario\"\nversion = 1\nname = \"lane\"\nenvironment = \"midsize_2001.toml\"\n"
              "duration_s = 2.0\n[[robot]]\nname = \"a\"\ntype = \"pioneer1.toml\"\n"
              "start = { x_m = 0.0, y_m = 0.0, heading_deg = 0 }\n[robot.controller]\nkind = \"plugin\"\nlibrary = \"" +
                  testPlugin(plugin) + "\"\n[robot.controller.options]\n" + more);
        return write("lane_trials.toml",
                     "format = \"mrose experiment\"\nversion = 1\nname = \"lane\"\nscenario = \"lane.toml\"\n"
                     "trials = 8\n[[draw]]\nname = \"d\"\n" +
                         draw + "[measures]\nx = 'robot[1].x'\n");
    }
    ProgramResult run(const std::string& file, const std::string& to, std::vector<std::string> more = {}) {
        std::vector<std::string> words{"experiment", file, "-o", path(to), "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return runMrose(words);
    }
    ResultsTable rows(const std::string& folder) {
        const auto table = readResultsTable(path(folder));
        EXPECT_TRUE(table) << table.error().message();
        return table ? *table : ResultsTable{};
    }
    /// The hashes of the last states, in the order of the rows.
    std::vector<std::string> hashes(const std::string& folder) {
        const ResultsTable table = rows(folder);
        std::vector<std::string> all;
        for (const auto& row : table.rows) all.push_back(row[table.columnOf("world_hash")]);
        return all;
    }

    const std::string speeds_ = "path = \"robot[1].controller.options.speed_mps\"\nfrom = 0.1\nto = 0.4\n";
};

TEST_F(PluginExperiment, RunsAreTheSameForAnyThreadsAndIsolated) {
    const std::string file = experiment("well_behaved", speeds_, "speed_mps = 0.1\n");
    ASSERT_EQ(run(file, "one", {"--threads", "1"}).status, 0);
    ASSERT_EQ(run(file, "eight", {"--threads", "8"}).status, 0);
    ASSERT_EQ(run(file, "apart", {"--isolate"}).status, 0);
    const std::vector<std::string> one = hashes("one");
    EXPECT_EQ(one.size(), 8u);
    EXPECT_EQ(hashes("eight"), one);
    EXPECT_EQ(hashes("apart"), one);
    EXPECT_NE(one[0], one[1]) << "another speed";
}

TEST_F(PluginExperiment, ATrialIsRepeatedByItsCommand) {
    const std::string file = experiment("well_behaved", speeds_, "speed_mps = 0.1\n");
    ASSERT_EQ(run(file, "all").status, 0);
    const ResultsTable table = rows("all");
    const ProgramResult again = runMrose({"run", file, "--trial", "3"});
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_THAT(again.out, HasSubstr("state " + table.rows[2][table.columnOf("world_hash")]));
}

/// It is the scenario's mistake, not that of the variant or the draw that is put into it.
TEST_F(PluginExperiment, APluginThatIsNotThereIsToldWhereTheScenarioNamesIt) {
    const std::string file = experiment("well_behaved", speeds_, "speed_mps = 0.1\n");
    write("lane.toml", replaced(read("lane.toml"), testPlugin("well_behaved"), "nothing.so"));
    write("lane_trials.toml", read("lane_trials.toml") + "[[variant]]\nname = \"east\"\n");
    const ProgramResult result = run(file, "refused");
    EXPECT_NE(result.status, 0);
    EXPECT_THAT(result.err, HasSubstr("lane.toml:12:11: "));
    EXPECT_THAT(result.err, HasSubstr("nothing.so"));
    EXPECT_EQ(result.err.find("east"), std::string::npos) << result.err;
}

TEST_F(PluginExperiment, FaultsAreInTheirRows) {
    const std::string file =
        experiment("misbehaving", "path = \"robot[1].controller.options.after_s\"\nof = [1.0, 100.0]\n",
                   "how = \"throw\"\nafter_s = 1.0\n");
    ASSERT_EQ(run(file, "all").status, 0);
    const ResultsTable table = rows("all");
    ASSERT_EQ(table.rows.size(), 8u);
    std::size_t faulty = 0;
    for (const auto& row : table.rows) {
        const bool early = row[table.columnOf("draw.d")] == "1.0";
        faulty += early ? 1 : 0;
        EXPECT_EQ(row[table.columnOf("end")], early ? "fault" : "duration");
        EXPECT_EQ(row[table.columnOf("fault")].find("threw: index 7") != std::string::npos, early);
    }
    EXPECT_GT(faulty, 0u);
    EXPECT_LT(faulty, 8u);
}

TEST_F(PluginExperiment, OptionsThatADrawMakesWrongAreToldOfIt) {
    const std::string file = experiment(
        "well_behaved", "path = \"robot[1].controller.options.speed_mps\"\nof = [-1.0]\n", "speed_mps = 0.1\n");
    expectOneLine(run(file, "none"), {"lane_trials.toml:", "draw[\"d\"]", "expected at least 0 (trial 1)"});
}

TEST_F(PluginExperiment, BuiltAgainItIsAnotherExperiment) {
    const std::string copy = path("own.so");
    std::filesystem::copy_file(testPlugin("well_behaved"), copy);
    const std::string file = experiment("well_behaved", speeds_, "speed_mps = 0.1\n");
    write("lane.toml", replaced(read("lane.toml"), testPlugin("well_behaved"), copy));
    ASSERT_EQ(run(file, "all").status, 0);
    std::filesystem::copy_file(testPlugin("misbehaving"), copy, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::copy_file(testPlugin("well_behaved"), copy, std::filesystem::copy_options::overwrite_existing);
    EXPECT_EQ(run(file, "all").status, 0) << "the same again";
    write("own.so", read("own.so") + '\0');
    expectOneLine(run(file, "all"), {"own.so"});
}

}  // namespace
}  // namespace mrose
