// Whatever the bytes are, a recording is opened up to where it is sound, its scenarios are made and its states reached,
// or it gives an error of one line; so are the parts that lie behind its compression and its CRCs, which arbitrary
// bytes do not get through, and saved states.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "fuzz/require.h"
#include "fuzz/small_descriptions.h"
#include "io/base64.h"
#include "io/compression.h"
#include "recording/block_bytes.h"
#include "recording/branch_scenario.h"
#include "recording/mcap_format.h"
#include "recording/playback.h"
#include "recording/recording.h"
#include "recording/tick_decisions.h"
#include "scenario/saved_state.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

constexpr std::int64_t mostTicks = 12;  // that are stepped again
constexpr std::size_t mostBodies = 50;

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

/// As who opens it for a look at its states does.
void requireReached(const Recording& recording, std::uint32_t branch) {
    Expected<ScenarioParts> parts = recordedScenario(recording, branch);
    if (!parts) return requireOneLine(parts.error());
    if (parts->scene.bodyCount() > mostBodies) return;
    const Scenario scenario(std::move(*parts));
    const Timeline& timeline = recording.branches[branch].timeline;
    Playback playback(scenario);
    for (const std::int64_t tick : {timeline.first(), std::min(timeline.last(), timeline.first() + mostTicks)}) {
        const Expected<ReachedState> reached = playback.reach(timeline, tick);
        if (!reached) return requireOneLine(reached.error());
        require(reached->state.tick == tick);
    }
}

void requireSound(const Expected<Recording>& recording) {
    if (!recording) return requireOneLine(recording.error());
    require(!recording->branches.empty());
    require(recording->layouts.size() == recording->branches.size());
    for (std::uint32_t i = 0; i < recording->branches.size(); ++i) {
        requireSound(recording->branches[i].timeline);
        requireReached(*recording, i);
    }
    for (const std::string& sentence : recording->damage) require(!sentence.empty());
}

void requireState(std::string_view bytes) {
    const Expected<WorldState> state = parseState(bytes, "state");
    if (!state) return requireOneLine(state.error());
    // What is of the first version is written in that of today.
    require(stateVersion(bytes) == 1 || stateBytes(*state) == bytes);
    require(parseState(stateBytes(*state), "state").has_value());
}

/// Blocks and branches begin with their version, as states do.
bool ofFirstVersion(std::string_view bytes) { return stateVersion(bytes) == 1; }

void requireBlock(std::string_view bytes) {
    const auto read = parseBlock(compressed(bytes));
    if (read && !ofFirstVersion(bytes)) require(decompressed(blockBytes(read->block, read->branch)) == bytes);
}

void requireBranch(std::string_view bytes) {
    const auto start = parseBranch(compressed(bytes));
    if (start && !ofFirstVersion(bytes)) require(decompressed(branchBytes(*start)) == bytes);
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

void appendMetadata(std::string& file, std::string_view name, const mcap::Strings& strings) {
    std::string content;
    mcap::appendText(content, name);
    mcap::appendStrings(content, strings);
    mcap::appendRecord(file, mcap::Kind::metadata, content);
}

const LoadedScenario& pair() {
    static const LoadedScenario loaded = [] {
        SmallDescriptions source({{"f", pairText}});
        return loadScenario("f", source).value();
    }();
    return loaded;
}

std::string_view takeLine(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
}

/// The beginning of a recording of the pair; `needs`: what its two controllers ask for.
std::string beginning(std::string_view tickLength, std::array<std::string_view, 2> needs) {
    static const std::string scenario =
        branchScenarioBytes({0, {20'000'000, {}}, std::make_shared<const ScenarioValue>(pair().value)}, nullptr);
    std::string file(mcap::magic);
    appendMetadata(file, "mrose.run", {{"format", "2"}, {"seed", "1"}, {"tick_length_ns", std::string(tickLength)}});
    appendMetadata(file, "mrose.controllers", {{"0", std::string(needs[0])}, {"1", std::string(needs[1])}});
    appendAttachment(file, "mrose/scenario/0", scenario);
    return file;
}

/// Of which the bytes are what the controllers ask for, a line each, and the pieces behind: branches, blocks, scenarios
/// of branches, each with its kind and its length before it.
std::string recordingOf(std::string_view bytes) {
    const std::string_view first = takeLine(bytes), second = takeLine(bytes);
    std::string file = beginning("20000000", {first, second});
    constexpr std::string_view kinds[] = {"mrose/block/0/0", "mrose/branch/0", "mrose/scenario/0", "other"};
    ByteReader reader(bytes);
    while (!reader.rest().empty() && !reader.failed()) {
        const auto head = reader.number<std::uint16_t>();
        const std::string_view piece = reader.take(head >> 2);
        appendAttachment(file, kinds[head & 3], compressed(piece));
    }
    return file;
}

/// Of which they are the metadata alone, a line each.
std::string recordingWith(std::string_view bytes) {
    static const std::string start = [] {
        const WorldState state = Scenario(pair().parts).initialState();
        return branchBytes({0, 0, "", {0, stateBytes(state), {}, {}}});
    }();
    const std::string_view tickLength = takeLine(bytes), first = takeLine(bytes), second = takeLine(bytes);
    std::string file = beginning(tickLength, {first, second});
    appendAttachment(file, "mrose/branch/0", start);
    return file;
}

/// A scenario that begins in the saved state of that text.
void requireGoesOn(const std::string& text) {
    const auto saved = parseSavedState(text, "state");
    if (!saved) return requireOneLine(saved.error());
    const auto again = parseSavedState(savedStateText(*saved), "state");
    require(again && stateBytes(again->state) == stateBytes(saved->state) && again->robots == saved->robots &&
            again->objects == saved->objects);
    std::string scenario = pairText;
    scenario.insert(scenario.find("seed"), "initial_state = \"x.state\"\n");
    SmallDescriptions source({{"f", scenario}, {"x.state", text}});
    for (const char* name : {"f", "x.state"}) {
        const auto loaded = loadScenario(name, source);
        if (!loaded) {
            requireOneLine(loaded.error());
            continue;
        }
        if (loaded->parts.scene.bodyCount() > mostBodies) continue;
        const Scenario from(loaded->parts);
        WorldState state = from.initialState();
        StepBuffers buffers;
        for (int i = 0; i < 3; ++i) step(from, state, buffers);
    }
}

/// The state of the pair as a file, but for its bytes.
void requireGoesOnFrom(std::string_view bytes) {
    const Scenario scenario(pair().parts);
    const SavedState saved = savedState(scenario, scenario.initialState());
    std::string text = savedStateText(saved);
    const std::size_t begin = text.find("\"\"\"\n") + 4, end = text.find("\"\"\"\n", begin);
    text.replace(begin, end - begin, base64(bytes));
    if (const auto state = parseState(bytes, "state")) {
        const std::string tick = "tick = " + std::to_string(saved.state.tick);
        text.replace(text.find(tick), tick.size(), "tick = " + std::to_string(state->tick));
    }
    requireGoesOn(text);
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
        case 'm':
            requireSound(parseRecording(recordingWith(rest), "metadata"));
            break;
        case 't':
            requireGoesOn(std::string(rest));
            break;
        case 'u':
            requireGoesOnFrom(rest);
            break;
        default:
            requireSound(parseRecording({reinterpret_cast<const char*>(data), size}, "recording"));
    }
    return 0;
}
