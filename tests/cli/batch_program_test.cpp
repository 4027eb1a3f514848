// `mrose batch` as its users run it.
#include <csignal>
#include <set>

#include "plugin/test_plugins.h"
#include "support/game_folder.h"
#include "support/places.h"

namespace mrose {
namespace {

using Json = nlohmann::json;

class BatchProgram : public GameFolder {
protected:
    /// What a row's command, typed into a shell, tells with --json.
    static Json alone(const std::string& command) {
        const std::string folder = std::filesystem::path(mroseProgram()).parent_path().string();
        return told(RunningProgram({"/bin/sh", "-c", "PATH='" + folder + "':$PATH; " + command + " --json"}).finish());
    }
    static void expectSame(const std::map<std::string, std::string>& row, const Json& run) {
        for (const char* key : {"trial", "seed", "touches", "kicks", "hits", "faults"})
            EXPECT_EQ(row.at(key), std::to_string(run[key].get<std::int64_t>())) << key << row.at("command");
        for (const char* key : {"end", "world_hash", "first_fault"})
            EXPECT_EQ(row.at(key), run[key]) << row.at("command");
        for (const char* key : {"time_s", "ball_still_s"}) EXPECT_EQ(std::stod(row.at(key)), run[key]);
        double driven = 0;
        for (const auto& [name, metres] : run["driven_m"].items()) driven += metres.get<double>();
        EXPECT_NEAR(std::stod(row.at("driven_m")), driven, 1e-12);
        for (const auto& [name, count] : run["goals"].items())
            EXPECT_EQ(row.at("goals." + name), std::to_string(count.get<int>()));
    }
};

TEST_F(BatchProgram, WritesARowForEachRunAndSumsUp) {
    const ProgramResult result =
        play("batch", {"--trials", "5", "--seeds", "2..3", "--duration", "1", "-o", path("out")});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    for (const std::string& part :
         {std::string("mean  least  most"), std::string("time, s"), std::string("touches"), std::string("goals.blue"),
          std::string("10 runs in "), "; results in " + path("out") + "/results.csv\n"})
        EXPECT_NE(result.out.find(part), std::string::npos) << result.out << part;
    const auto rows = csvRows(read("out/results.csv"));
    ASSERT_EQ(rows.size(), 10u);
    std::set<std::string> hashes;
    for (const auto& row : rows) hashes.insert(row.at("world_hash"));
    EXPECT_EQ(hashes.size(), 10u) << "every run is another one";
    EXPECT_EQ(listing(), (std::vector<std::string>{"it's a game.toml", "out", "out/batch.txt", "out/results.csv",
                                                   "out/scenario.value"}));
    const Json json =
        told(play("batch", {"--trials", "5", "--seeds", "2..3", "--duration", "1", "-o", path("out"), "--json"}));
    EXPECT_EQ(json["runs"], 10);
    EXPECT_EQ(json["resumed"], 10);
    const std::string again =
        play("batch", {"--trials", "5", "--seeds", "2..3", "--duration", "1", "-o", path("out")}).out;
    EXPECT_NE(again.find(" ms, 10 of them done before"), std::string::npos) << "less than a second: " << again;
    EXPECT_EQ(json["complete"], true);
    EXPECT_EQ(json["results"], path("out") + "/results.csv");
}

TEST_F(BatchProgram, SeedsAreTheScenariosUnlessGiven) {
    const auto seeds = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> words{"--trials", "1", "--duration", "0.1", "-o", path(name)};
        words.insert(words.end(), more.begin(), more.end());
        EXPECT_EQ(play("batch", words).status, 0);
        std::vector<std::string> found;
        for (const auto& row : csvRows(read(name + "/results.csv"))) found.push_back(row.at("seed"));
        return found;
    };
    EXPECT_EQ(seeds("own", {}), std::vector<std::string>{"5"});
    EXPECT_EQ(seeds("one", {"--seed", "8"}), std::vector<std::string>{"8"});
    EXPECT_EQ(seeds("two", {"--seeds", "8"}), std::vector<std::string>{"8"});
    EXPECT_EQ(seeds("range", {"--seeds", "9..11"}), (std::vector<std::string>{"9", "10", "11"}));
}

/// The scenario's name and the condition need a shell's quotes.
TEST_F(BatchProgram, CommandOfARowGivesThatRow) {
    const std::string until = "distance(robot[\"one's\"], ball) < 0.35 or time > 2.5";
    ASSERT_EQ(play("batch", {"--trials", "6", "--until", until, "-o", path("out")}).status, 0);
    const auto rows = csvRows(read("out/results.csv"));
    ASSERT_EQ(rows.size(), 6u);
    std::set<std::string> times;
    for (const auto& row : rows) {
        EXPECT_EQ(row.at("end"), "condition");
        times.insert(row.at("time_s"));
        expectSame(row, alone(row.at("command")));
    }
    EXPECT_GT(times.size(), 2u);
}

/// A plug-in that crashes: isolated its robot stops, else the program.
TEST_F(BatchProgram, CommandOfARowRunsPluginsAsTheBatchDid) {
    const std::string scenario =
        write("plug in.toml", replaced(read("it's a game.toml").empty() ? (game(), read("it's a game.toml")) : "",
                                       "controller = { kind = \"wander\" }",
                                       "controller = { kind = \"plugin\", library = \"" + testPlugin("misbehaving") +
                                           "\", options = { how = \"crash\", after_s = 0.5 } }"));
    const ProgramResult result = runMrose({"batch", scenario, "--trials", "2", "--duration", "1", "--isolate",
                                           "--plugin-limit", "7.5", "--quiet", "-o", path("out")});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find("with faults: 2\n"), std::string::npos) << result.out;
    for (const auto& row : csvRows(read("out/results.csv"))) {
        EXPECT_NE(row.at("command").find(" --isolate --plugin-limit 7.5 "), std::string::npos) << row.at("command");
        EXPECT_EQ(row.at("faults"), "1");
        expectSame(row, alone(row.at("command")));
    }
}

TEST_F(BatchProgram, WrongFlagsAreOneLine) {
    game();
    const auto before = listing();
    const std::pair<std::vector<std::string>, std::string> cases[] = {{{"--trials", "0"}, "--trials"},
                                                                      {{"--trials", "-4"}, "--trials"},
                                                                      {{"--trials", "many"}, "--trials"},
                                                                      {{"--trials", "10000001"}, "--trials"},
                                                                      {{"--seeds", "3..1"}, "--seeds: 3..1"},
                                                                      {{"--seeds", "1..x"}, "--seeds: 1..x"},
                                                                      {{"--seeds", "-1"}, "--seeds"},
                                                                      {{"--seeds", "1..2..3"}, "--seeds: 1..2..3"},
                                                                      {{"--seeds", "1", "--seed", "2"}, "--seed"},
                                                                      {{"--duration", "0"}, "--duration"},
                                                                      {{"--record", "x"}, "--record"}};
    for (const auto& [words, part] : cases) {
        std::vector<std::string> more{"-o", path("out")};
        more.insert(more.end(), words.begin(), words.end());
        expectOneLine(play("batch", more), {part}, 2);
    }
    expectOneLine(play("batch", {}), {"--output", "required"}, 2);
    expectOneLine(play("batch", {"--trials", "10000000", "--seeds", "1..2", "-o", path("out")}), {"too many runs"});
    expectOneLine(play("batch", {"--until", "ball.sped > 1", "-o", path("out")}), {"--until:1:6: ", "sped"});
    expectOneLine(runMrose({"batch", path("none.toml"), "-o", path("out")}), {"none.toml: does not exist"});
    expectOneLine(play("batch", {"-o", game()}), {"it's a game.toml: ", "director"});
    expectOneLine(play("batch", {"-o", "/proc/none"}), {"/proc/none: "});
    EXPECT_EQ(listing(), before);
}

TEST_F(BatchProgram, FoldersOfOtherBatchesAreRefused) {
    ASSERT_EQ(play("batch", {"--trials", "2", "--duration", "0.2", "-o", path("out")}).status, 0);
    const std::string before = read("out/results.csv");
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--duration", "0.2", "--trials", "1"},
                                                 {"--duration", "0.2", "--trials", "2", "--seeds", "1..2"},
                                                 {"--trials", "2", "--duration", "0.3"},
                                                 {"--trials", "2", "--duration", "0.2", "--until", "time > 9"}}) {
        std::vector<std::string> words{"-o", path("out")};
        words.insert(words.end(), more.begin(), more.end());
        const bool other = more[0] == "--trials";
        expectOneLine(play("batch", words),
                      {path("out") + (other ? ": holds other results: --" : ": holds a run of trial ")});
    }
    write("it's a game.toml", replaced(read("it's a game.toml"), "random_factor = 0.1", "random_factor = 0.2"));
    expectOneLine(
        runMrose({"batch", path("it's a game.toml"), "--trials", "2", "--duration", "0.2", "-o", path("out")}),
        {"holds other results"});
    EXPECT_EQ(read("out/results.csv"), before);
}

/// Neither how its path is spelled makes another batch, nor a condition that failed before there was a row.
TEST_F(BatchProgram, SameFilesAreTheSameBatch) {
    ASSERT_EQ(play("batch", {"--trials", "2", "--duration", "0.2", "-o", path("out")}).status, 0);
    const ProgramResult again = runMrose(
        {"batch", path("./it's a game.toml"), "--trials", "2", "--duration", "0.2", "--quiet", "-o", path("out")});
    EXPECT_EQ(again.status, 0) << again.err;
    const std::vector<std::string> wrong{"--trials", "2", "--until", "time > 0.1 and (nil).x > 2", "-o", path("new")};
    const ProgramResult failed = play("batch", wrong);
    EXPECT_EQ(failed.status, 1);
    EXPECT_NE(failed.err.find("--until:1:"), std::string::npos) << failed.err;
    EXPECT_EQ(play("batch", {"--trials", "2", "--until", "time > 0.1", "-o", path("new")}).status, 0);
    EXPECT_EQ(csvRows(read("new/results.csv")).size(), 2u);
}

TEST_F(BatchProgram, FolderWhoseResultsWereRemovedKeepsTheScenarioOfTheNextBatch) {
    ASSERT_EQ(play("batch", {"--trials", "1", "--duration", "0.2", "-o", path("again")}).status, 0);
    const std::string before = read("again/scenario.value");
    std::filesystem::remove(path("again/results.csv"));
    write("it's a game.toml", replaced(read("it's a game.toml"), "random_factor = 0.1", "random_factor = 0.2"));
    for (const char* folder : {"again", "fresh"})
        EXPECT_EQ(runMrose({"batch", path("it's a game.toml"), "--trials", "1", "--duration", "0.2", "--quiet", "-o",
                            path(folder)})
                      .status,
                  0);
    EXPECT_NE(read("again/scenario.value"), before);
    EXPECT_EQ(read("again/scenario.value"), read("fresh/scenario.value"));
}

TEST_F(BatchProgram, FullDiskIsOneLine) {
    game();
    expectOneLine(play("batch", {"--trials", "3", "--duration", "0.2", "-o", path("out")}, {.fullDisk = true}),
                  {"out/batch.txt: cannot be written: File too large"});
    // Room for the first rows: they stay, and the same command goes on.
    const std::vector<std::string> words{"--trials", "20", "--duration", "0.2", "-o", path("out")};
    expectOneLine(play("batch", words, {.fullDisk = true, .room = 1000}),
                  {"out/results.part.csv: cannot be written: File too large"});
    const std::string part = read("out/results.part.csv");
    EXPECT_TRUE(!part.empty() && part.ends_with('\n')) << part;
    const Json json = told(play("batch", {"--trials", "20", "--duration", "0.2", "-o", path("out"), "--json"}));
    EXPECT_EQ(json["resumed"], std::count(part.begin(), part.end(), '\n'));
    EXPECT_EQ(csvRows(read("out/results.csv")).size(), 20u);
}

/// Batches that are cut short: of as many trials as it takes to be caught under way.
class LongBatch : public BatchProgram {
protected:
    /// The status with which a signal ends a batch in `folder` that has shown how far it is; 0: none was caught.
    int cutShort(int signal, const std::string& folder) {
        for (; trials_ < 50'000; trials_ *= 2) {
            std::filesystem::remove_all(path(folder));
            RunningProgram program({mroseProgram(), "batch", game(), "--trials", std::to_string(trials_), "--duration",
                                    "2", "--threads", "2", "-o", path(folder)});
            const bool shown = program.waitForError(" of " + std::to_string(trials_) + " runs, ");
            program.send(signal);
            const int status = program.finish().status;
            if (shown && status != 0) return status;
        }
        return 0;
    }
    Json goOn(const std::string& folder) {
        return told(
            play("batch", {"--trials", std::to_string(trials_), "--duration", "2", "--json", "-o", path(folder)}));
    }
    /// Nothing is lost or done twice, whatever was cut short.
    void expectGoesOn() {
        EXPECT_EQ(read("out/results.csv"), "");
        const std::string part = read("out/results.part.csv");
        const auto rows = std::count(part.begin(), part.end(), '\n');
        EXPECT_GT(rows, 0);
        EXPECT_EQ(goOn("out")["resumed"], rows);
        EXPECT_EQ(goOn("whole")["resumed"], 0);
        EXPECT_EQ(read("out/results.csv"), read("whole/results.csv"));
        EXPECT_EQ(csvRows(read("out/results.csv")).size(), static_cast<std::size_t>(trials_));
    }

    int trials_ = 500;
};

TEST_F(LongBatch, KilledItGoesOnWhereItWas) {
    ASSERT_EQ(cutShort(SIGKILL, "out"), 128 + SIGKILL);
    expectGoesOn();
}

TEST_F(LongBatch, InterruptedItGoesOnWhereItWas) {
    ASSERT_EQ(cutShort(SIGINT, "out"), 130);
    expectGoesOn();
}

/// As a scheduler does it.
TEST_F(LongBatch, TerminatedItGoesOnWhereItWas) {
    ASSERT_EQ(cutShort(SIGTERM, "out"), 128 + SIGTERM);
    expectGoesOn();
}

TEST_F(LongBatch, OfManyStartsInANewFolderOneGoesOn) {
    const std::string scenario = game();
    std::vector<std::unique_ptr<RunningProgram>> programs;
    for (int i = 0; i < 12; ++i)
        programs.push_back(std::make_unique<RunningProgram>(
            std::vector<std::string>{mroseProgram(), "batch", scenario, "--trials", "50000", "--duration", "2",
                                     "--threads", "1", "-o", path("out")}));
    // Each says a line: how far it is, or what is wrong.
    for (const auto& program : programs) EXPECT_TRUE(program->waitForError("\n"));
    int atWork = 0;
    for (const auto& program : programs) {
        program->send(SIGINT);
        const ProgramResult result = program->finish();
        atWork += result.status == 130 ? 1 : 0;
        if (result.status != 130) expectOneLine(result, {path("out") + ": another mrose is at work in it"});
    }
    EXPECT_EQ(atWork, 1);
    EXPECT_EQ(listing(),
              (std::vector<std::string>{"it's a game.toml", "out", "out/batch.txt", "out/results.part.csv"}));
}

}  // namespace
}  // namespace mrose
