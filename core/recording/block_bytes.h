#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "recording/timeline.h"

namespace mrose {

/// A timeline's block as it lies in a recording, compressed, and back. README.md of this folder has the layout.
std::string blockBytes(const TimelineBlock& block, std::uint32_t branch);

struct ReadBlock {
    std::uint32_t branch = 0;
    TimelineBlock block;
};
/// nullopt where the bytes are no sound block: its parts do not fit, its keyframe is no state of its tick, or its
/// decisions are not those of its ticks.
std::optional<ReadBlock> parseBlock(std::string_view bytes);

/// How a branch begins, and back. The block has its keyframe only.
struct BranchStart {
    std::uint32_t branch = 0, parent = 0;
    std::string name;
    TimelineBlock block;
};
std::string branchBytes(const BranchStart& start);
std::optional<BranchStart> parseBranch(std::string_view bytes);

}  // namespace mrose
