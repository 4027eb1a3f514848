// The program computes the same where the C library takes other code for its sines and exponentials, as it does on a
// processor without AVX2 and FMA, and where its own kernels are those of such a processor.
#include <algorithm>

#include "learning/instruction_set.h"
#include "support/camera_folder.h"
#include "support/game_folder.h"
#include "support/game_text.h"
#include "support/places.h"
#include "support/test_data.h"

namespace mrose {
namespace {

/// For glibc alone.
const std::string olderProcessor = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA";

/// For what mrose itself chooses by processor, its networks' kernels.
std::string withKernels(InstructionSet set) { return std::string("MROSE_INSTRUCTION_SET=") + name(set); }

/// Variables for the environment: the C library and the kernels of all other processors.
std::vector<std::string> otherProcessors() {
    std::vector<std::string> variables{olderProcessor};
    for (const InstructionSet set : availableInstructionSets())
        if (set != bestInstructionSet()) variables.push_back(withKernels(set));
    return variables;
}

bool libraryCanChoose() {
#if defined(__x86_64__) && defined(__GLIBC__)
    return __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2");
#else
    return false;
#endif
}

class EveryProcessor : public GameFolder {
protected:
    void SetUp() override {
        if (!libraryCanChoose())
            GTEST_SKIP() << "the C library has no choice here: no glibc, or a processor without AVX2 and FMA";
    }
    /// What the program prints: the same on all of them.
    void expectSame(const std::vector<std::string>& words, const std::vector<std::string>& others = {olderProcessor}) {
        const ProgramResult here = runMrose(words);
        ASSERT_EQ(here.status, 0) << here.err;
        EXPECT_FALSE(here.out.empty());
        for (const std::string& other : others) {
            const ProgramResult there = runMrose(words, {.variable = other});
            EXPECT_EQ(there.status, 0) << there.err;
            EXPECT_EQ(here.out, there.out) << words[0] << ' ' << words[1] << ", " << other;
        }
    }
    /// Run on both, to the same hash, and what one recorded decided again by the other.
    void expectSameRun(const std::string& scenario, const std::string& seconds,
                       const std::vector<std::string>& more = {}) {
        std::vector<std::string> words{"run", scenario, "--duration", seconds, "--quiet", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        expectSame(words);
        words.insert(words.end(), {"--record", path("run.mcap")});
        ASSERT_EQ(runMrose(words).status, 0);
        const std::vector<std::string> again{"replay", path("run.mcap"), "--decide", "--quiet", "--json"};
        EXPECT_EQ(told(runMrose(again, {.variable = olderProcessor}))["same"], true) << scenario;
    }
};

/// Without this none of the others says anything.
TEST_F(EveryProcessor, TheLibraryItselfDoesDiffer) {
    const std::vector<std::string> words{MROSE_LIBRARY_SUMS};
    const ProgramResult here = RunningProgram(words).finish();
    const ProgramResult there = RunningProgram(words, {.variable = olderProcessor}).finish();
    ASSERT_EQ(here.status, 0);
    ASSERT_EQ(there.status, 0);
    EXPECT_EQ(std::count(here.out.begin(), here.out.end(), '\n'), 6);
    EXPECT_NE(here.out, there.out);
}

TEST_F(EveryProcessor, KernelsAreThoseThatAreNamed) {
    for (const InstructionSet set : availableInstructionSets()) {
        const ProgramResult version = runMrose({"--version"}, {.variable = withKernels(set)});
        EXPECT_TRUE(version.out.ends_with(std::string(" ") + name(set) + '\n')) << version.out;
    }
}

TEST_F(EveryProcessor, SoccerIsTheSame) { expectSameRun("soccer.toml", "120"); }

TEST_F(EveryProcessor, CorridorIsTheSame) { expectSameRun("b21_corridor.toml", "120"); }

TEST_F(EveryProcessor, GameOfTestsIsTheSame) { expectSameRun(game(), "300"); }

/// Robots of every kind crowd around a ball.
TEST_F(EveryProcessor, CrowdIsTheSame) {
    std::string text = gameText();
    int number = 0;
    for (const char* const kind : {"b21", "create", "human", "husky", "nomad200", "pioneer1", "reference"})
        for (const char* const target : {"[4.8, 0.0]", "[-4.8, 0.0]"}) {
            const std::string name = "'more " + std::to_string(++number) + '\'',
                              x = std::to_string(-3.5 + 0.5 * number), y = number % 2 == 0 ? "2.0" : "-1.5";
            text += "\n[[robot]]\nname = " + name + "\ntype = '" + kind + ".toml'\nstart = { x_m = " + x +
                    ", y_m = " + y + " }\ncontroller = { kind = 'chase_ball', target_m = " + target + " }\n";
        }
    expectSameRun(write("crowd.toml", text), "120");
}

/// Five robots that see landmarks and each other by learned cameras: what these remember, which hangs on what was
/// reported, is in the hash.
TEST_F(EveryProcessor, LearnedCamerasAreTheSame) {
    std::string text =
        "format = 'mrose scenario'\nversion = 1\nname = 'cameras'\nenvironment = 'mrclam_arena.toml'\nseed = 3\n";
    for (int i = 1; i <= 5; ++i) {
        const std::string number = std::to_string(i);
        text += "[[robot]]\nname = '" + number + "'\ntype = 'create.toml'\nmotion_robot = '" + number +
                "'\nstart = { x_m = " + std::to_string(0.8 * i) + ", y_m = " + std::to_string(i % 3) +
                ", heading_deg = " + std::to_string(70 * i) + " }\ncontroller = { kind = 'wander' }\n";
    }
    const std::string scenario = write("cameras.toml", text);
    expectSameRun(scenario, "60");
    expectSame({"run", scenario, "--duration", "60", "--quiet", "--json"}, otherProcessors());
    const std::vector<std::string> words{
        "run",     scenario, "--duration", "60",
        "--quiet", "--json", "--until",    "robot[1].camera.landmarks + robot[1].camera.robots >= 3"};
    EXPECT_LT(told(runMrose(words))["time_s"].get<double>(), 60) << "they report nothing";
    expectSame(words, otherProcessors());
}

/// With the errors of their readings.
TEST_F(EveryProcessor, PredictedReadingsAreTheSame) {
    const CameraFolder folder;
    std::string queries = "dataset,robot,t,subject\n";
    for (int i = 0; i < 200; ++i)
        for (int subject = 6; subject < 18; ++subject)
            queries += "1,1," + std::to_string(1'248'444'190 + i) + ".25," + std::to_string(subject) + '\n';
    write("queries.csv", queries);
    const auto predicted = [&](const std::string& variable) {
        const ProgramResult result =
            runMrose({"predict", (sourceFolder() / "nets/create_camera.net").string(), "--log", folder.path(),
                      "--queries", path("queries.csv"), "-o", path("predicted.csv"), "--overwrite", "--quiet"},
                     {.variable = variable});
        EXPECT_EQ(result.status, 0) << result.err;
        return read("predicted.csv");
    };
    const std::string here = predicted("");
    EXPECT_EQ(std::ranges::count(here, '\n'), 1 + 40 * 12 * 200);
    for (const std::string& other : otherProcessors()) EXPECT_TRUE(here == predicted(other)) << other;
}

TEST_F(EveryProcessor, MrclamReplayIsTheSame) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    const auto log = *data / "mrclam" / "MRCLAM_Dataset6";
    if (!std::filesystem::exists(log)) GTEST_SKIP() << "no MRCLAM data set 6 there";
    expectSameRun("mrclam_replay.toml", "60", {"--log", log.string()});
}

TEST_F(EveryProcessor, ConditionsAreTheSame) {
    expectSame({"run", "soccer.toml", "--duration", "10", "--quiet", "--json", "--until",
                "pow(sin(time) + exp(robot[1].x / 7) * atan(robot[2].y, 3), 1.3) + log(time + 1) + tan(time) > 40"});
}

/// Noise, wheels and drives of the reference robot.
TEST_F(EveryProcessor, GeneratedLogsAreTheSame) {
    for (const bool older : {false, true})
        ASSERT_EQ(runMrose({"generate", "--set", "example", "-o", path(older ? "older" : "here"), "--quiet"},
                           {.variable = older ? olderProcessor : ""})
                      .status,
                  0);
    std::size_t files = 0;
    for (const std::string& name : listing()) {
        if (!name.starts_with("here/") || std::filesystem::is_directory(path(name))) continue;
        EXPECT_TRUE(read(name) == read("older" + name.substr(4))) << name;
        ++files;
    }
    EXPECT_GT(files, 0u);
}

TEST_F(EveryProcessor, IdentificationIsTheSame) {
    expectSame({"inspect", log(), "--json", "--quiet"}, otherProcessors());
    expectSame({"evaluate", network(), "--log", log(), "--json", "--quiet"}, otherProcessors());
}

TEST_F(EveryProcessor, LearningIsTheSame) {
    const std::vector<std::vector<std::string>> kinds{{},
                                                      {"--model", "state"},
                                                      {"--model", "velocity"},
                                                      {"--model", "paper"},
                                                      {"--model", "paper", "--loss", "one-step", "--method", "lm"}};
    for (const std::vector<std::string>& kind : kinds) {
        std::vector<std::string> words = trainWords(path("learned.net"));
        words.insert(words.end(), {"--overwrite", "--quiet"});
        words.insert(words.end(), kind.begin(), kind.end());
        const auto learned = [&](const std::string& variable) {
            const ProgramResult result = runMrose(words, {.variable = variable});
            EXPECT_EQ(result.status, 0) << result.err;
            return read("learned.net");
        };
        const std::string here = learned("");
        EXPECT_FALSE(here.empty());
        for (const std::string& other : otherProcessors())
            EXPECT_TRUE(here == learned(other)) << (kind.empty() ? "history" : kind[1]) << ", " << other;
    }
}

}  // namespace
}  // namespace mrose
