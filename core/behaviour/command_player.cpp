#include "behaviour/command_player.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace mrose {
namespace {

struct Memory {
    std::uint64_t next;  ///< the first command not yet issued
};

}  // namespace

CommandPlayer::CommandPlayer(const std::vector<StampedCommand>& commands, Attention reads) : reads_(std::move(reads)) {
    for (const StampedCommand& command : commands) {
        assert(commands_.empty() || command.time > commands_.back().time);
        if (commands_.empty() || !identical(commands_.back().command, command.command)) commands_.push_back(command);
    }
}

std::size_t CommandPlayer::memorySize() const { return sizeof(Memory); }

std::size_t CommandPlayer::commandsPerPeriod(Nanoseconds period) const {
    std::size_t most = 1;
    for (std::size_t first = 0, end = 0; first < commands_.size(); ++first) {
        while (end < commands_.size() && commands_[end].time < commands_[first].time + period) ++end;
        most = std::max(most, end - first);
    }
    return most;
}

void CommandPlayer::explain(std::span<const std::byte> memory, MemoryEntries& entries) const {
    entries.add("commands played", static_cast<double>(as<Memory>(memory).next));
    entries.add("commands in all", static_cast<double>(commands_.size()));
}

void CommandPlayer::decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const {
    std::uint64_t& next = as<Memory>(memory).next;
    for (; next < commands_.size() && commands_[next].time <= observation.time; ++next)
        decision.earlier.push_back(commands_[next]);
}

}  // namespace mrose
