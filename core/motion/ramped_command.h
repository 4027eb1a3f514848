#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "world/command_history.h"

namespace mrose {

/// A command as a drive of limited acceleration can follow it: where the command jumps, what is followed goes there
/// evenly. Its means over parts of the history are exact.
class RampedCommand {
public:
    static constexpr std::size_t mostPieces = CommandHistory::capacity + 1;

    /// Pieces of constant command, newest first: piece i, of `values[i * stride]`, lasts from `ages[i]` to `ages[i +
    /// 1]` s ago. What is followed is taken to have reached the oldest piece's command where that begins.
    /// `acceleration`, of the command's unit per second, is positive.
    RampedCommand(double acceleration, std::span<const double> ages, const double* values, std::size_t stride);

    /// Over the time from `oldest` to `newest` s ago, newest < oldest, within the pieces.
    double mean(double newest, double oldest) const;

private:
    /// From here on to the knot after it, what is followed changes evenly.
    struct Knot {
        double age, value;
        double travelled;  ///< integral from the oldest knot to this one
    };
    void add(double age, double value);
    double travelledAt(double age) const;

    std::array<Knot, 2 * mostPieces + 1> knots_;  ///< the first `count_`, oldest first
    std::size_t count_ = 0;
};

}  // namespace mrose
