#include "recording/block_bytes.h"

#include <cstring>

#include "io/bytes.h"
#include "io/compression.h"
#include "recording/tick_decisions.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

/// 1: the hashes were those of the states' first version.
constexpr std::uint32_t version = 2;

bool soundKeyframe(const TimelineBlock& block) {
    const Expected<WorldState> state = parseState(block.keyframe, {});
    return state && state->tick == block.first;
}

bool soundDecisions(const TimelineBlock& block) {
    DecisionReader reader(block.decisions);
    for (std::size_t i = 0; i < block.hashes.size(); ++i)
        if (!reader.next(DecisionsOf::all)) return false;
    return reader.done();
}

/// Ticks far beyond all runs are not computed with.
bool soundTick(std::int64_t tick) { return tick >= 0 && tick < std::int64_t{1} << 48; }

}  // namespace

std::string blockBytes(const TimelineBlock& block, std::uint32_t branch) {
    std::string bytes;
    appendNumber(bytes, version);
    appendNumber(bytes, branch);
    appendNumber(bytes, block.first);
    appendLong(bytes, block.keyframe);
    appendNumber(bytes, std::uint64_t{block.hashes.size()});
    for (const StateHash& hash : block.hashes) appendNumber(bytes, hash.world);
    for (const StateHash& hash : block.hashes) appendNumber(bytes, hash.memories);
    appendLong(bytes, block.decisions);
    return compressed(bytes);
}

std::optional<ReadBlock> parseBlock(std::string_view bytes) {
    const std::optional<std::string> content = decompressed(bytes);
    if (!content) return std::nullopt;
    ByteReader reader(*content);
    const auto found = reader.number<std::uint32_t>();
    if (found < 1 || found > version) return std::nullopt;
    ReadBlock read;
    read.branch = reader.number<std::uint32_t>();
    TimelineBlock& block = read.block;
    block.first = reader.number<std::int64_t>();
    block.keyframe = readLong(reader);
    const auto ticks = reader.number<std::uint64_t>();
    if (reader.failed() || ticks > reader.rest().size() / sizeof(StateHash) || !soundTick(block.first))
        return std::nullopt;
    block.hashes.resize(ticks);
    for (StateHash& hash : block.hashes) hash.world = reader.number<std::uint64_t>();
    for (StateHash& hash : block.hashes) hash.memories = reader.number<std::uint64_t>();
    block.decisions = readLong(reader);
    if (found == 1) block.firstVersion = block.hashes.size();
    if (!reader.done() || (!block.keyframe.empty() && !soundKeyframe(block)) || !soundDecisions(block))
        return std::nullopt;
    return read;
}

std::string branchBytes(const BranchStart& start) {
    std::string bytes;
    appendNumber(bytes, version);
    appendNumber(bytes, start.branch);
    appendNumber(bytes, start.parent);
    appendNumber(bytes, start.block.first);
    appendLong(bytes, start.name);
    appendLong(bytes, start.block.keyframe);
    return compressed(bytes);
}

std::optional<BranchStart> parseBranch(std::string_view bytes) {
    const std::optional<std::string> content = decompressed(bytes);
    if (!content) return std::nullopt;
    ByteReader reader(*content);
    if (const auto found = reader.number<std::uint32_t>(); found < 1 || found > version) return std::nullopt;
    BranchStart start;
    start.branch = reader.number<std::uint32_t>();
    start.parent = reader.number<std::uint32_t>();
    start.block.first = reader.number<std::int64_t>();
    start.name = readLong(reader);
    start.block.keyframe = readLong(reader);
    if (!reader.done() || !soundTick(start.block.first) || !soundKeyframe(start.block)) return std::nullopt;
    return start;
}

}  // namespace mrose
