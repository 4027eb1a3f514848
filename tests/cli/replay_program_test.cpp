// `mrose replay` as its users run it: what is the same, what differs, and what is wrong with a recording.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "io/file.h"
#include "recording/recording_writer.h"
#include "scenario/scenario_file.h"
#include "simulation/step.h"
#include "support/game_folder.h"
#include "support/places.h"

namespace mrose {
namespace {

/// What a recording in which something is amiss was made with.
struct Amiss {
    std::function<ScenarioValue(const ScenarioValue&)> value = {};  ///< what it says its scenario is
    Origin origin = thisOrigin();
    std::int64_t falseTick = -1;  ///< the ball's place in the state after it is off by the last bit ...
    bool inBranch = false;        ///< ... of the branch
};

class ReplayProgram : public GameFolder {
protected:
    static constexpr std::int64_t ticks = 150, branchTick = 60, branchTicks = 40;

    ProgramResult replay(const std::string& file, const std::vector<std::string>& more = {}) {
        std::vector<std::string> words{"replay", path(file), "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return runMrose(words);
    }
    /// The game, recorded by the program.
    void recordByProgram() { EXPECT_EQ(play("run", {"--record", path("game.mcap")}).status, 0); }
    /// The same as game.mcap with a branch in which the ball is thrown, written here.
    void recordHere(const Amiss& amiss);
    /// A run, and a branch of it that begins anew with something overridden; `broken` is in what is kept of it, too.
    void recordReloaded(const std::string& assignment, const std::string& broken = "");
};

void ReplayProgram::recordHere(const Amiss& amiss) {
    DiskDescriptions source({sourceFolder(), {}, ""});
    auto loaded = loadScenario(game(), source);
    ASSERT_TRUE(loaded) << loaded.error().message();
    const auto value = std::make_shared<const ScenarioValue>(amiss.value ? amiss.value(loaded->value) : loaded->value);
    const Scenario scenario(loaded->parts);
    WorldState state = scenario.initialState(), other;
    auto writer = RecordingWriter::create(path("game.mcap"), scenario, state, value, "mrose run",
                                          {.overwrite = true, .origin = amiss.origin});
    ASSERT_TRUE(writer) << writer.error().message();
    StepBuffers buffers;
    StepTrace trace;
    const auto add = [&](WorldState& s, std::uint32_t branch) {
        step(scenario, s, buffers, {}, &trace);
        WorldState told = s;
        double& x = told.objects[0].pose.x;
        if (s.tick == amiss.falseTick && amiss.inBranch == (branch != 0)) x = std::nextafter(x, 1e9);
        writer->add(told, trace, branch);
    };
    for (std::int64_t k = 0; k < ticks; ++k) {
        add(state, 0);
        if (state.tick == branchTick) other = state;
    }
    writer->keep(state);
    other.objects[0].velocity_W = {-1, 2, 0};
    const std::uint32_t branch = writer->beginBranch(0, other, "thrown");
    for (std::int64_t k = 0; k < branchTicks; ++k) add(other, branch);
    writer->keep(other, branch);
    ASSERT_TRUE(writer->close());
}

void ReplayProgram::recordReloaded(const std::string& assignment, const std::string& broken) {
    DiskDescriptions source({sourceFolder(), {}, ""});
    auto loaded = loadScenario(game(), source);
    ASSERT_TRUE(loaded) << loaded.error().message();
    const auto changed = loaded->value.overridden(assignment);
    ASSERT_TRUE(changed) << changed.error().message();
    auto again = loadScenario(*changed);
    ASSERT_TRUE(again) << again.error().message();
    const auto told = broken.empty() ? changed : changed->overridden(broken);
    ASSERT_TRUE(told) << told.error().message();
    const Scenario scenario(loaded->parts), reloaded(again->parts);
    auto writer =
        RecordingWriter::create(path("game.mcap"), scenario, scenario.initialState(),
                                std::make_shared<const ScenarioValue>(loaded->value), "", {.overwrite = true});
    ASSERT_TRUE(writer) << writer.error().message();
    EXPECT_EQ(writer->beginBranch(0, reloaded.initialState(), "reloaded", reloaded,
                                  std::make_shared<const ScenarioValue>(*told)),
              1u);
    for (const std::uint32_t branch : {0u, 1u}) {
        const Scenario& own = branch == 0 ? scenario : reloaded;
        WorldState state = own.initialState();
        StepBuffers buffers;
        StepTrace trace;
        for (std::int64_t k = 0; k < branchTicks; ++k) {
            step(own, state, buffers, {}, &trace);
            writer->add(state, trace, branch);
        }
        writer->keep(state, branch);
    }
    ASSERT_TRUE(writer->close());
}

TEST_F(ReplayProgram, SaysThatItIsTheSameByDecisionsAndByControllers) {
    recordByProgram();
    const auto before = listing();
    const ProgramResult plain = replay("game.mcap"), decided = replay("game.mcap", {"--decide"});
    for (const ProgramResult& result : {plain, decided}) {
        EXPECT_EQ(result.status, 0) << result.out << result.err;
        EXPECT_EQ(result.err, "");
    }
    EXPECT_EQ(plain.out, "150 ticks replayed, the recorded decisions in force: the same to the last bit\n");
    EXPECT_EQ(decided.out, "150 ticks replayed, the controllers deciding again: the same to the last bit\n");
    const nlohmann::json json = told(replay("game.mcap", {"--json"}));
    EXPECT_EQ(json["ticks"], 150);
    EXPECT_EQ(json["same"], true);
    EXPECT_EQ(json["branches"], 1);
    EXPECT_TRUE(json["damage"].empty());
    EXPECT_EQ(listing(), before);
}

TEST_F(ReplayProgram, BranchesAreReplayedToo) {
    recordHere({});
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--json"}, {"--json", "--decide"}}) {
        const nlohmann::json json = told(replay("game.mcap", more));
        EXPECT_EQ(json["ticks"], ticks + branchTicks);
        EXPECT_EQ(json["branches"], 2);
        EXPECT_EQ(json["same"], true);
    }
}

/// A branch whose scenario was changed.
TEST_F(ReplayProgram, BranchesAreReplayedInTheirOwnScenario) {
    recordReloaded("robot[1].controller.target_m=[0.0, 2.5]");
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--json"}, {"--json", "--decide"}}) {
        const nlohmann::json json = told(replay("game.mcap", more));
        EXPECT_EQ(json["ticks"], branchTicks + branchTicks);
        EXPECT_EQ(json["same"], true) << json;
    }
    recordReloaded("robot[1].controller.target_m=[0.0, 2.5]", "tick_s=0.0");
    expectOneLine(replay("game.mcap"), {"it's a game.toml: tick_s: is 0.0; expected 0.001 to 0.1"});
}

/// The last bit of one number in one tick of the run, or of its branch.
TEST_F(ReplayProgram, NamesTheFirstTickThatDiffers) {
    for (const bool inBranch : {false, true}) {
        const std::int64_t tick = inBranch ? branchTick + 17 : 33;
        recordHere({.falseTick = tick, .inBranch = inBranch});
        for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--decide"}}) {
            const ProgramResult result = replay("game.mcap", more);
            EXPECT_EQ(result.status, 1);
            EXPECT_EQ(result.err, "");
            const std::string begins = "differs first at tick " + std::to_string(tick);
            EXPECT_TRUE(result.out.starts_with(begins)) << result.out;
            EXPECT_EQ(result.out.find(" of branch 1: ") != std::string::npos, inBranch) << result.out;
        }
        const ProgramResult result = replay("game.mcap", {"--json"});
        EXPECT_EQ(result.status, 1);
        const nlohmann::json json = nlohmann::json::parse(result.out);
        EXPECT_EQ(json["same"], false);
        EXPECT_EQ(json["difference"]["tick"], tick);
        EXPECT_EQ(json["difference"]["branch"], inBranch ? 1 : 0);
        EXPECT_NE(json["difference"]["what"], "");
    }
}

/// The scenario in the recording has another target for the controller than the one that decided.
TEST_F(ReplayProgram, ChangedControllerIsNamedWhereItDecidesAgainAndOnlyThere) {
    recordHere({.value = [](const ScenarioValue& value) {
        return value.overridden("robot[1].controller.target_m = [0.0, 2.5]").value();
    }});
    EXPECT_EQ(replay("game.mcap").status, 0);
    const ProgramResult decided = replay("game.mcap", {"--decide"});
    EXPECT_EQ(decided.status, 1);
    EXPECT_TRUE(decided.out.starts_with("differs first at tick ")) << decided.out;
    EXPECT_NE(decided.out.find("robot 1 (one's)"), std::string::npos) << decided.out;
}

TEST_F(ReplayProgram, OtherBuildsVersionsAndStepsAreSaid) {
    Origin origin = thisOrigin();
    origin.version = "0.0.7";
    origin.commit = "abcdef";
    origin.step = 1;
    recordHere({.origin = origin});
    const ProgramResult result = replay("game.mcap");
    EXPECT_EQ(result.status, 0) << result.out;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 3) << result.err;
    for (const char* part : {"mrose: it was recorded by mrose 0.0.7; this is ",
                             "mrose: it was recorded by a build of commit abcdef; this is ",
                             "mrose: it was recorded by step 1 of mrose; this is step "})
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err << part;
}

/// Each bit that is altered is either in what other programs see alone, or said.
TEST_F(ReplayProgram, AlteredBitsAreSaid) {
    recordByProgram();
    const std::string whole = read("game.mcap");
    int said = 0;
    for (std::size_t i = 1; i < 24; ++i) {
        std::string altered = whole;
        altered[i * whole.size() / 24] ^= 0x10;
        write("altered.mcap", altered);
        const ProgramResult result = replay("altered.mcap");
        EXPECT_LE(result.status, 1) << result.err;
        if (result.err.empty()) {
            EXPECT_EQ(result.status, 0) << result.out;
            EXPECT_TRUE(result.out.starts_with("150 ticks replayed")) << result.out;
        } else {
            EXPECT_TRUE(result.err.starts_with("mrose: ")) << result.err;
            ++said;
        }
    }
    EXPECT_GT(said, 12);
}

TEST_F(ReplayProgram, CutRecordingIsReplayedUpToItsCut) {
    // Long enough for several parts.
    EXPECT_EQ(play("run", {"--record", path("game.mcap"), "--duration", "60"}).status, 0);
    const std::string whole = read("game.mcap");
    std::int64_t last = 0;
    for (const double share : {0.5, 0.75, 0.999}) {
        write("cut.mcap", whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
        const ProgramResult result = replay("cut.mcap", {"--json"});
        EXPECT_EQ(result.status, 0) << result.out << result.err;
        EXPECT_TRUE(result.err.starts_with("mrose: ")) << result.err;
        const nlohmann::json json = nlohmann::json::parse(result.out);
        EXPECT_EQ(json["same"], true);
        EXPECT_EQ(json["damage"].size(), 1u);
        EXPECT_GT(json["ticks"], last);
        EXPECT_LE(json["ticks"], 3000);
        last = json["ticks"];
    }
    write("cut.mcap", whole.substr(0, 100));
    expectOneLine(replay("cut.mcap"), {"cut.mcap: "});
}

TEST_F(ReplayProgram, WhatIsNoRecordingIsOneLine) {
    expectOneLine(replay("none.mcap"), {"none.mcap: "});
    write("text.mcap", "no recording");
    expectOneLine(replay("text.mcap"), {"text.mcap: "});
    write("empty.mcap", "");
    expectOneLine(replay("empty.mcap"), {"empty.mcap: "});
    expectOneLine(runMrose({"replay"}), {"RECORDING", "required"}, 2);
    expectOneLine(replay("text.mcap", {"--decided"}), {"--decided"}, 2);
}

}  // namespace
}  // namespace mrose
