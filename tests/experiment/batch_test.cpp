#include "experiment/batch.h"

#include <atomic>
#include <set>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "experiment/run.h"
#include "experiment/trial_world.h"
#include "experiment/variation.h"
#include "io/file.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/units.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

class Batch : public testing::Test {
protected:
    Batch() {
        options_.trials = 6;
        options_.firstSeed = 3;
        options_.lastSeed = 5;
        options_.duration = 2 * second;
        options_.command = "mrose run it.toml";
    }
    std::filesystem::path folder(const std::string& name) const { return folder_.path() / name; }
    std::string results(const std::string& name) const {
        return readFile(folder(name) / "results.csv").value_or("none");
    }
    Expected<BatchSummary> run(const std::string& name) { return runBatch(parts_, options_, folder(name)); }
    /// The same in one go, on one thread.
    std::string uninterrupted() {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        BatchOptions options = options_;
        options.progress = {};
        options.goesOn = {};
        EXPECT_TRUE(runBatch(parts_, options, folder("whole")));
        return results("whole");
    }

    TemporaryFolder folder_;
    ScenarioParts parts_ = trialWorld();
    BatchOptions options_;
};

/// The cells of a line; quotes are taken off.
std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> result(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            result.emplace_back();
        else
            result.back() += c;
    }
    return result;
}

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> result;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) result.push_back(line);
    return result;
}

TEST_F(Batch, EveryTrialWithEverySeedHasARowInOrder) {
    const auto summary = run("out");
    ASSERT_TRUE(summary) << summary.error().message();
    EXPECT_TRUE(summary->complete);
    EXPECT_EQ(summary->runs, 18);
    EXPECT_EQ(summary->resumed, 0);
    const std::vector<std::string> rows = lines(results("out"));
    ASSERT_EQ(rows.size(), 19u);
    EXPECT_EQ(rows[0],
              "trial,seed,end,time_s,touches,kicks,hits,faults,driven_m,\"goals east\",world_hash,command,first_fault");
    std::set<std::string> hashes;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::vector<std::string> row = cells(rows[i]);
        EXPECT_EQ(row[0], std::to_string(1 + (i - 1) / 3));
        EXPECT_EQ(row[1], std::to_string(3 + (i - 1) % 3));
        EXPECT_EQ(row[11], "mrose run it.toml --trial " + row[0] + " --seed " + row[1]);
        hashes.insert(row[10]);
    }
    EXPECT_EQ(hashes.size(), 18u) << "every run is another one";
}

/// Against run() of the same trial and seed, alone.
TEST_F(Batch, RowsSayWhatTheRunsDid) {
    ASSERT_TRUE(run("out"));
    const std::vector<std::string> rows = lines(results("out"));
    for (const std::size_t i : {1, 8, 18}) {
        const std::vector<std::string> row = cells(rows[i]);
        const auto parts = varied(parts_, static_cast<std::uint32_t>(std::stoul(row[0])));
        ASSERT_TRUE(parts);
        const Scenario scenario(*parts);
        RunOptions options;
        options.duration = options_.duration;
        const auto alone = mrose::run(scenario, scenario.initialState(std::stoul(row[1])), options);
        ASSERT_TRUE(alone);
        EXPECT_EQ(std::stoull(row[10], nullptr, 16), hashOf(alone->state).world);
        EXPECT_EQ(row[2], "duration");
        EXPECT_EQ(std::stod(row[3]), 2);
        EXPECT_EQ(std::stoll(row[4]), alone->statistics.touches);
        EXPECT_EQ(std::stod(row[8]), alone->statistics.driven[0] + alone->statistics.driven[1]);
        EXPECT_EQ(std::stoi(row[9]), alone->state.goals[0]);
    }
}

TEST_F(Batch, SummaryIsOfAllRows) {
    options_.until = "distance(robot[1], robot[2]) < 0.8";
    const auto summary = run("out");
    ASSERT_TRUE(summary) << summary.error().message();
    const std::vector<std::string> rows = lines(results("out"));
    double touches = 0, least = 1e9, most = -1;
    int ended = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::vector<std::string> row = cells(rows[i]);
        touches += std::stod(row[4]);
        least = std::min(least, std::stod(row[3]));
        most = std::max(most, std::stod(row[3]));
        ended += row[2] == "condition" ? 1 : 0;
        EXPECT_TRUE(row[2] == "condition" || row[3] == "2.0") << rows[i];
    }
    const ResultsSummary& results = summary->results;
    EXPECT_EQ(results.rows, 18);
    EXPECT_EQ(results.ended, ended);
    EXPECT_TRUE(ended > 0 && ended < 18) << ended;
    EXPECT_EQ(results.faulty, 0);
    ASSERT_EQ(results.columns.size(), 7u);
    EXPECT_EQ(results.columns[0].least, least);
    EXPECT_EQ(results.columns[0].most, most);
    EXPECT_NEAR(results.columns[1].mean, touches / 18, 1e-12);
    EXPECT_EQ(results.columns[6].name, "goals in east");
    const auto again = run("out");
    ASSERT_TRUE(again);
    EXPECT_EQ(again->resumed, 18);
    EXPECT_EQ(again->results.ended, ended) << "of rows done before, too";
}

TEST_F(Batch, ThreadsMakeNoDifference) {
    const std::string one = uninterrupted();
    for (const std::size_t threads : {2, 5}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const std::string name = "threads" + std::to_string(threads);
        ASSERT_TRUE(run(name));
        EXPECT_EQ(results(name), one);
    }
}

/// Stopped again and again, it does each run once.
TEST_F(Batch, GoesOnWhereItWasStopped) {
    std::atomic<std::int64_t> done{0};
    std::int64_t before = 0;
    std::set<std::int64_t> counts;
    options_.progress = [&](std::int64_t now, std::int64_t all) {
        EXPECT_TRUE(counts.insert(now).second) << "nothing is done twice";
        EXPECT_EQ(all, 18);
        ++done;
    };
    options_.goesOn = [&] { return done < before + 4; };
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    for (int calls = 1;; ++calls) {
        before = done;
        const auto summary = run("out");
        ASSERT_TRUE(summary) << summary.error().message();
        EXPECT_EQ(summary->resumed, before);
        EXPECT_EQ(summary->results.rows, done);
        if (summary->complete) {
            EXPECT_EQ(calls, 5);
            break;
        }
        EXPECT_EQ(results("out"), "none");
        ASSERT_LT(calls, 10);
    }
    EXPECT_EQ(done, 18);
    EXPECT_EQ(results("out"), uninterrupted());
}

/// A run of a year is under way when it is to stop.
TEST_F(Batch, StopsWithinARun) {
    options_.duration = 365LL * 24 * 3600 * second;
    std::atomic<int> asked{0};
    options_.goesOn = [&] { return ++asked < 50; };
    const auto summary = run("out");
    ASSERT_TRUE(summary) << summary.error().message();
    EXPECT_FALSE(summary->complete);
    EXPECT_EQ(summary->results.rows, 0);
    EXPECT_TRUE(summary->results.columns.empty() || summary->results.columns[0].mean == 0);
}

TEST_F(Batch, GoesOnAfterARowWasCutOff) {
    const std::string whole = uninterrupted();
    std::atomic<int> done{0};
    options_.progress = [&](std::int64_t, std::int64_t) { ++done; };
    options_.goesOn = [&] { return done < 7; };
    ASSERT_TRUE(run("out"));
    const std::string part = *readFile(folder("out") / "results.part.csv");
    folder_.write("out/results.part.csv", part.substr(0, part.size() - 30));
    options_.goesOn = {};
    const auto summary = run("out");
    ASSERT_TRUE(summary);
    EXPECT_EQ(summary->resumed, std::count(part.begin(), part.end(), '\n') - 1);
    EXPECT_EQ(results("out"), whole);
}

TEST_F(Batch, OtherBatchesAreRefused) {
    ASSERT_TRUE(run("out"));
    const std::string before = results("out");
    const auto refused = [&] {
        const auto other = run("out");
        EXPECT_FALSE(other);
        return !other && other.error().message().find("holds results of another batch") != std::string::npos;
    };
    const BatchOptions same = options_;
    options_.trials = 7;
    EXPECT_TRUE(refused());
    options_ = same;
    options_.firstTrial = 2;
    EXPECT_TRUE(refused());
    options_ = same;
    options_.lastSeed = 6;
    EXPECT_TRUE(refused());
    options_ = same;
    options_.command += " --isolate";
    EXPECT_TRUE(refused());
    options_ = same;
    options_.identity = "another scenario";
    EXPECT_TRUE(refused());
    EXPECT_EQ(results("out"), before);
}

TEST_F(Batch, WrongConditionsAndOverlapsAreToldAndNothingIsMade) {
    options_.until = "ball.sped > 3";
    const auto wrong = run("out");
    ASSERT_FALSE(wrong);
    EXPECT_NE(wrong.error().message().find("sped"), std::string::npos) << wrong.error().message();
    EXPECT_FALSE(std::filesystem::exists(folder("out")));
    parts_.scene.environment = walledField(0.401, 0.401);
    parts_.scene.robots.resize(1);
    parts_.controllers.resize(1);
    parts_.scene.objects.clear();
    parts_.scene.robots[0].start = {0.2005, 0.2005, 0};
    parts_.variation.robotPosition = 0.15;
    options_.until = "";
    const auto crowded = run("crowded");
    ASSERT_FALSE(crowded);
    EXPECT_NE(crowded.error().message().find("in a hundred draws of trial "), std::string::npos);
    EXPECT_EQ(results("crowded"), "none");
}

/// It holds at the start, but needs ever more instructions.
TEST_F(Batch, ConditionThatLoopsForEverEndsIt) {
    options_.until = "(function() while time > 1 do end return false end)()";
    const auto endless = run("out");
    ASSERT_FALSE(endless);
    EXPECT_NE(endless.error().message().find("instructions"), std::string::npos) << endless.error().message();
    EXPECT_EQ(results("out"), "none");
}

TEST_F(Batch, TooManyRunsAreRefused) {
    for (const auto& [trials, last] : {std::pair<std::uint32_t, std::uint64_t>{4'000'000'000U, 5},
                                       {1, std::numeric_limits<std::uint64_t>::max()},
                                       {10'000, 3'000}}) {
        options_.trials = trials;
        options_.firstSeed = 0;
        options_.lastSeed = last;
        const auto many = run("out");
        ASSERT_FALSE(many);
        EXPECT_NE(many.error().message().find("are too many runs; expected at most 10000000"), std::string::npos)
            << many.error().message();
    }
    options_.trials = 1;
    options_.firstSeed = options_.lastSeed = std::numeric_limits<std::uint64_t>::max();
    EXPECT_TRUE(run("last seed"));
}

}  // namespace
}  // namespace mrose
