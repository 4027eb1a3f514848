#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "motion/actuator_limits.h"
#include "world/command_history.h"

namespace mrose {

/// A command as a drive of limited accelerations can follow it: where the command jumps, what is followed goes there
/// evenly. Its means over parts of the history are exact.
class RampedCommand {
public:
    static constexpr std::size_t mostPieces = CommandHistory::capacity + 1;

    /// Pieces of constant command, newest first: piece i, of v `commands[i * stride]` and w `commands[i * stride + 1]`,
    /// lasts from `ages[i]` to `ages[i + 1]` s ago. `begun` is what is followed where the oldest piece begins. Ages and
    /// commands must stay while anything is asked for.
    RampedCommand(const ActuatorLimits& limits, std::span<const double> ages, const double* commands,
                  std::size_t stride, const Command& begun);

    /// Over the time from `oldest` to `newest` s ago, newest < oldest, within the pieces. Quick where the parts are
    /// asked for from the newest on.
    Command mean(double newest, double oldest);

    /// What is followed `age` s ago, within the pieces.
    Command at(double age) const;

private:
    static constexpr std::size_t channels = 2;
    using Channels = std::array<double, channels>;

    std::span<const double> ages_;
    const double* commands_;
    std::size_t stride_;
    Channels accelerations_;                         ///< the largest number of a channel without a limit
    Channels halfAccelerations_, perAccelerations_;  ///< 0 of a channel without a limit
    std::array<Channels, mostPieces> begun_;         ///< what is followed where a piece begins
    std::size_t newest_ = 0;                         ///< the newest piece of the part that was asked for last
};

}  // namespace mrose
