// recording_seeds FOLDER: what recording_fuzz begins with, made of a short run by the code of today, so that its seeds
// never grow older than the format. Each begins with the letter by which the fuzzer knows its kind.
#include <cstdio>
#include <filesystem>
#include <string>

#include "fuzz/small_descriptions.h"
#include "io/compression.h"
#include "io/file.h"
#include "recording/block_bytes.h"
#include "recording/branch_scenario.h"
#include "recording/match.h"
#include "recording/recording_writer.h"
#include "scenario/saved_state.h"
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

enum class Piece : std::uint16_t { block, branch, scenario };

std::string piece(const std::string& bytes, Piece kind) {
    std::string head;
    appendNumber(head, static_cast<std::uint16_t>(bytes.size() << 2 | static_cast<std::uint16_t>(kind)));
    return head + bytes;
}

/// A scenario and its value.
struct Told {
    Scenario scenario;
    ScenarioValuePointer value;
};
Expected<Told> toldBy(const std::string& name, const std::string& text) {
    SmallDescriptions source({{name, text}});
    auto loaded = loadScenario(name, source);
    if (!loaded) return tl::unexpected(loaded.error());
    return Told{Scenario(std::move(loaded->parts)), std::make_shared<const ScenarioValue>(std::move(loaded->value))};
}

Expected<std::string> recordedFile(const Told& told, const Told& other, const StraightRun& run,
                                   const std::string& path) {
    RecordingWriter::Options options;
    options.overwrite = true;
    options.keyframeInterval = 5;
    auto writer = RecordingWriter::create(path, told.scenario, run.states.front(), told.value, "", options);
    if (!writer) return tl::unexpected(writer.error());
    for (std::size_t i = 0; i < run.traces.size(); ++i) writer->add(run.states[i + 1], run.traces[i]);
    const StraightRun branch = runMatch(other.scenario, run.states[branchTick], 3);
    writer->beginBranch(0, branch.states.front(), "b", other.scenario, other.value);
    for (std::size_t i = 0; i < branch.traces.size(); ++i) writer->add(branch.states[i + 1], branch.traces[i], 1);
    if (const auto closed = writer->close(); !closed) return tl::unexpected(closed.error());
    return readFile(path);
}

Expected<void> writeSeeds(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    std::string otherText = pairText;
    otherText.replace(otherText.find("seed = 3"), 8, "seed = 4");
    const Expected<Told> told = toldBy("f", pairText), other = toldBy("g", otherText);
    if (!told || !other) return tl::unexpected((told ? other : told).error());
    const StraightRun run = runMatch(told->scenario, told->scenario.initialState(), ticks, hand);
    const Expected<std::string> whole = recordedFile(*told, *other, run, (folder / "whole").string());
    if (!whole) return tl::unexpected(whole.error());
    const Expected<Recording> recording = parseRecording(*whole, "whole");
    if (!recording) return tl::unexpected(recording.error());
    const auto branch = [&](std::uint32_t number, std::int64_t tick) {
        return *decompressed(
            branchBytes({number, 0, "b", {tick, stateBytes(run.states[static_cast<std::size_t>(tick)]), {}, {}}}));
    };
    const Value::File odd = std::make_shared<const DescriptionFile>(DescriptionFile{"s", "s", "text"});
    const Value named = Value::Table{{"seed", 2}, {"shape", odd}, {"x", Value::Array{1.5, true, "y"}}};
    const std::string own = *decompressed(
                          branchScenarioBytes({1, recording->layouts[1], other->value}, told->value.get())),
                      alone = *decompressed(branchScenarioBytes(
                          {1, {20'000'000, {{16, 2}}}, std::make_shared<const ScenarioValue>("t", named)}, nullptr));
    std::string needs, block;
    for (const auto& controller : recording->header.controllers)
        needs += std::to_string(controller.memorySize) + ' ' + std::to_string(controller.commandsPerPeriod) + '\n';
    std::string pieces = needs + piece(branch(0, 0), Piece::branch);
    for (const TimelineBlock& part : recording->branches[0].timeline.blocks())
        pieces += piece(block = *decompressed(blockBytes(part, 0)), Piece::block);
    pieces += piece(own, Piece::scenario) + piece(branch(1, branchTick), Piece::branch);
    const std::string state = stateBytes(run.states.back());
    const SavedState saved = savedState(told->scenario, run.states.back());
    for (const auto& [name, bytes] :
         {std::pair("cut", whole->substr(0, 2 * whole->size() / 3)), std::pair("state", 's' + state),
          std::pair("branch", 'a' + branch(0, 0)), std::pair("block", 'b' + block), std::pair("scenario", 'n' + alone),
          std::pair("pieces", 'p' + pieces), std::pair("metadata", "m20000000\n" + needs),
          std::pair("saved", 't' + savedStateText(saved)),
          std::pair("saved_whole", 't' + savedStateText(saved, told->value.get())), std::pair("goes_on", 'u' + state)})
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
