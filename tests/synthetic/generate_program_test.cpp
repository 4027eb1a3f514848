#include <array>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "io/file.h"
#include "logs/csv_reader.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

struct Outcome {
    int status = -1;
    std::string text;  ///< standard output and error
};

/// Runs `mrose generate` with the arguments, after the shell's `before`.
Outcome generate(const std::string& arguments, const std::string& before = "") {
    Outcome outcome;
    FILE* pipe = ::popen((before + " '" + mroseProgram() + "' generate " + arguments + " 2>&1").c_str(), "r");
    if (pipe == nullptr) return outcome;
    std::array<char, 4096> buffer{};
    while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), pipe))
        outcome.text.append(buffer.data(), got);
    const int status = ::pclose(pipe);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

/// One line, about the cause, and failure.
void expectRefused(const Outcome& outcome, const std::string& cause) {
    EXPECT_NE(outcome.status, 0);
    EXPECT_EQ(outcome.text.find('\n'), outcome.text.size() - 1) << outcome.text;
    EXPECT_TRUE(outcome.text.starts_with("mrose: ")) << outcome.text;
    EXPECT_NE(outcome.text.find(cause), std::string::npos) << outcome.text;
}

TEST(GenerateProgram, WritesALogThatSaysItIsSynthetic) {
    const TemporaryFolder folder;
    const std::string out = (folder.path() / "made").string();
    const Outcome outcome =
        generate("--pattern random --trajectories 2 --duration 10 --repeats 2 --seed 4 --json -q -o " + out);
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const auto json = nlohmann::json::parse(outcome.text);
    EXPECT_TRUE(json.at("synthetic"));
    EXPECT_EQ(json.at("files").at(0).at("trajectories"), 4);
    EXPECT_DOUBLE_EQ(json.at("files").at(0).at("seconds"), 40);
    const auto log = readCsv(out);
    ASSERT_TRUE(log) << log.error().message();
    EXPECT_TRUE(log->synthetic);
    EXPECT_EQ(log->robots.at(0).trajectories.size(), 4u);
}

TEST(GenerateProgram, SameSeedSameBytes) {
    const TemporaryFolder folder;
    const auto bytes = [&](const std::string& name, int seed) {
        const auto out = folder.path() / name;
        const Outcome outcome = generate("--pattern jink -q --seed " + std::to_string(seed) + " -o " + out.string());
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        EXPECT_EQ(outcome.text, "");
        return readFile(out / "jink.csv").value();
    };
    const std::string first = bytes("a", 1);
    EXPECT_EQ(first, bytes("b", 1));
    EXPECT_NE(first, bytes("c", 2));
}

TEST(GenerateProgram, RefusesWithOneLine) {
    const TemporaryFolder folder;
    const std::string file = folder.write("file", "x").string(), out = (folder.path() / "out").string();
    expectRefused(generate("--pattern jink -q -o /proc/at/all"), "/proc/at/all: cannot make the folder");
    expectRefused(generate("--pattern jink -q -o " + file), "cannot make the folder");
    expectRefused(generate("-q -o " + out), "--set, --pattern");
    expectRefused(generate("--set example --pattern jink -q -o " + out), "--set, --pattern");
    expectRefused(generate("--set nothing -q -o " + out), "nothing");
    expectRefused(generate("--pattern jink --trajectories 0 -q -o " + out), "--trajectories");
    expectRefused(generate("--pattern random --trajectories 100000 -q -o " + out), "1,000,000 s");
    folder.write("taken/jink.csv/inside", "x");
    expectRefused(generate("--pattern jink -q -o " + (folder.path() / "taken").string()), "is a folder");
}

TEST(GenerateProgram, AFullDiskLeavesTheEarlierLog) {
    const TemporaryFolder folder;
    const auto earlier = folder.write("random.csv", "what was there\n");
    const Outcome outcome = generate("--pattern random --trajectories 4 -q --overwrite -o " + folder.path().string(),
                                     "trap '' XFSZ; ulimit -f 64;");
    expectRefused(outcome, "random.csv: cannot be written");
    EXPECT_EQ(readFile(earlier).value(), "what was there\n");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace mrose
