#pragma once

#include <vector>

#include "control/controller.h"

namespace mrose {

/// Issues given commands, each with its own time: a velocity script, or the log of a real robot. Times count from the
/// run's start; commands from before it are issued at the first control instant, so that a motion model reads back
/// into them. After the last one that stays in force. What it reads changes nothing: it is there to be shown.
class CommandPlayer final : public Controller {
public:
    /// In strictly ascending order of time. Those that repeat the one in force are left out.
    explicit CommandPlayer(const std::vector<StampedCommand>& commands, Attention reads = Attention::ofItself());

    std::size_t memorySize() const override;
    std::size_t commandsPerPeriod(Nanoseconds period) const override;
    Attention attention() const override { return reads_; }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override;

private:
    std::vector<StampedCommand> commands_;
    Attention reads_;
};

}  // namespace mrose
