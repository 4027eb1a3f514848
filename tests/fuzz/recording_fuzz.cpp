// Whatever the bytes are, a recording is opened up to where it is sound, or gives an error of one line; so are the
// parts that lie behind its compression and its CRCs, which arbitrary bytes do not get through.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "fuzz/require.h"
#include "io/compression.h"
#include "recording/block_bytes.h"
#include "recording/branch_scenario.h"
#include "recording/decision_bytes.h"
#include "recording/mcap_format.h"
#include "recording/recording.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

/// Every tick has its hash and its decisions.
void requireSound(const Timeline& timeline) {
    require(timeline.first() <= timeline.last());
    for (const TimelineBlock& block : timeline.blocks()) {
        const Expected<WorldState> state = parseState(block.keyframe, "keyframe");
        require(state && state->tick == block.first);
        DecisionReader decisions(block.decisions);
        for (std::size_t i = 0; i < block.hashes.size(); ++i) require(decisions.next(DecisionsOf::all));
        require(decisions.done());
    }
    if (timeline.last() > timeline.first()) timeline.hashAt(timeline.last());
}

void requireSound(const Expected<Recording>& recording) {
    if (!recording) return requireOneLine(recording.error());
    require(!recording->branches.empty());
    require(recording->layouts.size() == recording->branches.size());
    for (const Branch& branch : recording->branches) requireSound(branch.timeline);
    for (const std::string& sentence : recording->damage) require(!sentence.empty());
}

void requireState(std::string_view bytes) {
    const Expected<WorldState> state = parseState(bytes, "state");
    if (!state) return requireOneLine(state.error());
    require(stateBytes(*state) == bytes);
}

void requireBlock(std::string_view bytes) {
    const auto read = parseBlock(compressed(bytes));
    if (read) require(decompressed(blockBytes(read->block, read->branch)) == bytes);
}

void requireBranch(std::string_view bytes) {
    const auto start = parseBranch(compressed(bytes));
    if (start) require(decompressed(branchBytes(*start)) == bytes);
}

void requireBranchScenario(std::string_view bytes) {
    const ScenarioValue run("s", Value::Table{{"seed", 1}});
    const auto read = parseBranchScenario(compressed(bytes), &run, {{"s", "seed = 1\n"}});
    if (!read) return;
    const auto again = parseBranchScenario(branchScenarioBytes(*read, &run), &run);
    require(again && again->branch == read->branch && *again->value == *read->value &&
            again->layout.tickLength == read->layout.tickLength &&
            again->layout.controllers == read->layout.controllers);
}

void appendAttachment(std::string& file, std::string_view name, std::string_view data) {
    std::string content;
    appendNumber(content, std::int64_t{0});
    appendNumber(content, std::int64_t{0});
    mcap::appendText(content, name);
    mcap::appendText(content, "");
    appendNumber(content, std::uint64_t{data.size()});
    content += data;
    appendNumber(content, std::uint32_t{0});  // a CRC of 0 is not checked
    mcap::appendRecord(file, mcap::Kind::attachment, content);
}

/// A recording whose branches and blocks are the pieces of the bytes, each with its length before it.
std::string recordingOf(std::string_view bytes) {
    std::string file(mcap::magic), run;
    mcap::appendText(run, "mrose.run");
    mcap::appendStrings(run, {{"format", "1"}, {"seed", "1"}, {"tick_length_ns", "20000000"}});
    mcap::appendRecord(file, mcap::Kind::metadata, run);
    std::string controllers;
    mcap::appendText(controllers, "mrose.controllers");
    mcap::appendStrings(controllers, {{"0", "16 1"}});
    mcap::appendRecord(file, mcap::Kind::metadata, controllers);
    ByteReader reader(bytes);
    while (!reader.rest().empty() && !reader.failed()) {
        const auto head = reader.number<std::uint16_t>();
        const std::string_view piece = reader.take(head >> 1);
        appendAttachment(file, (head & 1) != 0 ? "mrose/branch/0" : "mrose/block/0/0", compressed(piece));
    }
    return file;
}

}  // namespace
}  // namespace mrose

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace mrose;
    if (size == 0) return 0;
    const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
    switch (data[0]) {
        case 's':
            requireState(rest);
            break;
        case 'b':
            requireBlock(rest);
            break;
        case 'a':
            requireBranch(rest);
            break;
        case 'n':
            requireBranchScenario(rest);
            break;
        case 'p':
            requireSound(parseRecording(recordingOf(rest), "pieces"));
            break;
        default:
            requireSound(parseRecording({reinterpret_cast<const char*>(data), size}, "recording"));
    }
    return 0;
}
