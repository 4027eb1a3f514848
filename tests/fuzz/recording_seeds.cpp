// recording_seeds FOLDER: what recording_fuzz begins with, made of a short match by the code of today, so that its
// seeds never grow older than the format. Each begins with the letter by which the fuzzer knows its kind.
#include <cstdio>
#include <filesystem>
#include <string>

#include "io/compression.h"
#include "io/file.h"
#include "recording/block_bytes.h"
#include "recording/branch_scenario.h"
#include "recording/match.h"
#include "recording/recording_writer.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

constexpr std::int64_t ticks = 12, branchTick = 5;

/// Now and then orders of all kinds come from outside.
std::vector<RobotDecision> hand(std::int64_t tick) {
    if (tick % 5 != 0) return {};
    Decision decision;
    decision.earlier = {{0, {0.1, 0}}};
    decision.command = Command{0.5, -1};
    decision.kicks = {{0, 1}};
    if (tick == 5) decision.fault = "x";
    return {{0, decision}};
}

std::string piece(const std::string& bytes, bool branch) {
    std::string head;
    appendNumber(head, static_cast<std::uint16_t>(bytes.size() << 1 | (branch ? 1 : 0)));
    return head + bytes;
}

Expected<std::string> recordedFile(const Scenario& scenario, const StraightRun& run, const std::string& path) {
    RecordingWriter::Options options;
    options.overwrite = true;
    options.keyframeInterval = 5;
    const auto own = std::make_shared<const ScenarioValue>("s", Value::Table{{"seed", 1}});
    const auto others = std::make_shared<const ScenarioValue>("t", Value::Table{{"seed", 2}});
    auto writer = RecordingWriter::create(path, scenario, run.states.front(), own, "", options);
    if (!writer) return tl::unexpected(writer.error());
    for (std::size_t i = 0; i < run.traces.size(); ++i) writer->add(run.states[i + 1], run.traces[i]);
    const StraightRun branch = runMatch(scenario, run.states[branchTick], 3);
    writer->beginBranch(0, branch.states.front(), "b", scenario, others);
    for (std::size_t i = 0; i < branch.traces.size(); ++i) writer->add(branch.states[i + 1], branch.traces[i], 1);
    if (const auto closed = writer->close(); !closed) return tl::unexpected(closed.error());
    return readFile(path);
}

Expected<void> writeSeeds(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    MatchOptions small;
    small.robots = 2;
    small.lively = false;
    const Scenario scenario(matchParts(small));
    const StraightRun run = runMatch(scenario, scenario.initialState(), ticks, hand);
    const Expected<std::string> whole = recordedFile(scenario, run, (folder / "whole").string());
    if (!whole) return tl::unexpected(whole.error());
    const Expected<Recording> recording = parseRecording(*whole, "whole");
    if (!recording) return tl::unexpected(recording.error());
    const auto& blocks = recording->branches[0].timeline.blocks();
    const std::string first = *decompressed(branchBytes({0, 0, "", {0, stateBytes(run.states.front()), {}, {}}}));
    const Value::File odd = std::make_shared<const DescriptionFile>(DescriptionFile{"s", "s", "text"});
    const Value named = Value::Table{{"seed", 2}, {"shape", odd}, {"x", Value::Array{1.5, true, "y"}}};
    const std::string own = *decompressed(
        branchScenarioBytes({1, {20'000'000, {{16, 2}}}, std::make_shared<const ScenarioValue>("t", named)}, nullptr));
    std::string pieces = piece(first, true), block;
    for (const TimelineBlock& part : blocks) pieces += piece(block = *decompressed(blockBytes(part, 0)), false);
    for (const auto& [name, bytes] :
         {std::pair("cut", whole->substr(0, 2 * whole->size() / 3)),
          std::pair("state", 's' + stateBytes(run.states.back())), std::pair("branch", 'a' + first),
          std::pair("block", 'b' + block), std::pair("scenario", 'n' + own), std::pair("pieces", 'p' + pieces)})
        if (const auto written = writeFileAtomically(folder / name, bytes); !written) return written;
    return {};
}

}  // namespace
}  // namespace mrose

int main(int argc, char** argv) {
    if (argc != 2) return 2;
    const auto written = mrose::writeSeeds(argv[1]);
    if (!written) std::fprintf(stderr, "%s\n", written.error().message().c_str());
    return written ? 0 : 1;
}
