#include "experiment/batch.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "experiment/run.h"
#include "experiment/trial_world.h"
#include "io/file.h"
#include "scenario/variation.h"
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

/// Of trialWorld(): poses of two robots, the place and the mass of a ball, two frictions.
constexpr std::size_t variedColumns = 11;

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
    const std::vector<std::string> header = cells(rows[0]);
    const std::vector<std::string> first{"trial", "seed",   "end",      "time_s",       "touches",   "kicks",
                                         "hits",  "faults", "driven_m", "ball_still_s", "goals.east"},
        last{"world_hash", "command", "first_fault"};
    ASSERT_EQ(header.size(), first.size() + variedColumns + last.size());
    EXPECT_TRUE(std::equal(first.begin(), first.end(), header.begin()));
    EXPECT_TRUE(std::equal(last.begin(), last.end(), header.end() - 3));
    std::set<std::string> hashes;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::vector<std::string> row = cells(rows[i]);
        EXPECT_EQ(row[0], std::to_string(1 + (i - 1) / 3));
        EXPECT_EQ(row[1], std::to_string(3 + (i - 1) % 3));
        EXPECT_EQ(row[12 + variedColumns], "mrose run it.toml --trial " + row[0] + " --seed " + row[1]);
        hashes.insert(row[11 + variedColumns]);
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
        EXPECT_EQ(std::stoull(row[11 + variedColumns], nullptr, 16), hashOf(alone->state).world);
        EXPECT_EQ(row[2], "duration");
        EXPECT_EQ(std::stod(row[3]), 2);
        EXPECT_EQ(std::stoll(row[4]), alone->statistics.touches);
        EXPECT_EQ(std::stod(row[8]), alone->statistics.driven[0] + alone->statistics.driven[1]);
        EXPECT_EQ(std::stod(row[9]) * nanosecondsPerSecond, alone->statistics.ballStill);
        EXPECT_EQ(std::stoi(row[10]), alone->state.goals[0]);
    }
}

TEST_F(Batch, SummaryIsOfAllRows) {
    options_.until = "distance(robot[1], robot[2]) < 0.8";
    const auto summary = run("out");
    ASSERT_TRUE(summary) << summary.error().message();
    const std::vector<std::string> rows = lines(results("out"));
    const ResultsSummary& results = summary->results;
    ASSERT_EQ(results.columns.size(), 8u);
    EXPECT_EQ(results.columns[7].name, "goals.east");
    // Each column's numbers, sorted; the first is the fourth cell.
    for (std::size_t c = 0; c < results.columns.size(); ++c) {
        std::vector<double> numbers;
        for (std::size_t i = 1; i < rows.size(); ++i) numbers.push_back(std::stod(cells(rows[i])[3 + c]));
        std::sort(numbers.begin(), numbers.end());
        EXPECT_EQ(results.columns[c].least, numbers.front());
        EXPECT_EQ(results.columns[c].most, numbers.back());
        EXPECT_NEAR(results.columns[c].mean, std::accumulate(numbers.begin(), numbers.end(), 0.0) / 18, 1e-12);
    }
    std::int64_t ended = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const std::vector<std::string> row = cells(rows[i]);
        ended += row[2] == "condition" ? 1 : 0;
        EXPECT_TRUE(row[2] == "condition" || row[3] == "2.0") << rows[i];
    }
    EXPECT_EQ(results.rows, 18);
    EXPECT_EQ(results.ended, ended);
    EXPECT_TRUE(ended > 0 && ended < 18) << ended;
    EXPECT_EQ(results.faulty, 0);
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
    options_.identity["scenario"] = "one.toml";
    ASSERT_TRUE(run("out"));
    const std::string before = results("out");
    const auto refused = [&] {
        const auto other = run("out");
        EXPECT_FALSE(other);
        return !other && other.error().message().find("holds other results") != std::string::npos;
    };
    const BatchOptions same = options_;
    options_.identity["scenario"] = "another.toml";
    EXPECT_TRUE(refused());
    for (const auto& [trials, firstSeed] : {std::pair{5U, 3U}, std::pair{6U, 4U}}) {
        options_ = same;
        options_.trials = trials;
        options_.firstSeed = firstSeed;
        const auto fewer = run("out");
        ASSERT_FALSE(fewer);
        EXPECT_NE(fewer.error().message().find(trials == 5 ? "holds a run of trial 6 with seed 3"
                                                           : "holds a run of trial 1 with seed 3"),
                  std::string::npos)
            << fewer.error().message();
    }
    EXPECT_EQ(results("out"), before);
}

/// Whatever commands the rows of before have: how plug-ins are run is no part of a batch.
TEST_F(Batch, MoreTrialsAndSeedsGoOn) {
    const std::string whole = uninterrupted();
    options_.trials = 4;
    options_.lastSeed = 4;
    ASSERT_TRUE(run("out"));
    options_.trials = 6;
    options_.lastSeed = 5;
    std::set<std::pair<std::uint32_t, std::uint64_t>> begun;
    std::mutex mutex;
    options_.begins = [&](const RunKey& key) {
        const std::lock_guard lock(mutex);
        begun.insert({key.trial, key.seed});
    };
    const auto more = run("out");
    ASSERT_TRUE(more) << more.error().message();
    EXPECT_EQ(more->resumed, 8);
    EXPECT_EQ(more->runs, 18);
    EXPECT_EQ(results("out"), whole);
    EXPECT_EQ(begun.size(), 10u);
    EXPECT_TRUE(begun.contains({5, 3}) && begun.contains({1, 5}) && !begun.contains({1, 3}));
    options_.command += " --isolate";
    EXPECT_TRUE(run("out"));
    EXPECT_EQ(results("out"), whole);
}

/// Against varied() itself, for each thing that varies.
TEST_F(Batch, RowsSayWhatWasVaried) {
    parts_.variation = {0.2, 0.3, 0.1, 0.2, 0.3};
    options_.duration = second / 10;
    options_.lastSeed = 3;
    ASSERT_TRUE(run("out"));
    const std::vector<std::string> rows = lines(results("out")), header = cells(rows[0]);
    for (std::uint32_t trial = 1; trial <= 6; ++trial) {
        const std::vector<std::string> row = cells(rows[trial]);
        const auto value = [&](const std::string& name) {
            const auto column = std::find(header.begin(), header.end(), name);
            EXPECT_NE(column, header.end()) << name << rows[0];
            return column == header.end() ? 0 : std::stod(row[static_cast<std::size_t>(column - header.begin())]);
        };
        const Scene scene = varied(parts_, trial)->scene;
        for (const SceneRobot& robot : scene.robots) {
            EXPECT_EQ(value("start x_m " + robot.name), robot.start.x);
            EXPECT_EQ(value("start y_m " + robot.name), robot.start.y);
            EXPECT_NEAR(value("start heading_deg " + robot.name) * std::numbers::pi / 180, robot.start.heading, 1e-12);
        }
        for (const SceneObject& object : scene.objects) {
            EXPECT_EQ(value("start x_m " + object.name), object.start.x);
            EXPECT_EQ(value("mass_kg " + object.name), scene.objectTypes[object.type].mass);
        }
        EXPECT_EQ(value("sliding_friction"), scene.environment.floor.slidingFriction);
        EXPECT_EQ(value("rolling_deceleration_mps2"), scene.environment.floor.rollingDeceleration);
    }
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
    const std::string message = endless.error().message();
    EXPECT_THAT(message, testing::MatchesRegex("--until: .*instructions.* \\(trial [1-6], seed [3-5]\\)"));
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
