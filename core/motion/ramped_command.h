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

    /// Pieces of constant command, newest first: piece i, of `values[i * stride]`, lasts from `ages[i]` to
    /// `ages[i + 1]` s ago. What is followed is taken to have reached the oldest piece's command where that begins.
    /// `acceleration`, of the command's unit per second, is positive. Only what was followed up to `oldest` s ago,
    /// within the pieces, is asked for.
    RampedCommand(double acceleration, std::span<const double> ages, const double* values, std::size_t stride,
                  double oldest);

    /// Over the time from `oldest` to `newest` s ago, newest < oldest. Quick where the parts are asked for from the
    /// newest on.
    double mean(double newest, double oldest);

private:
    /// From here on to the knot after it, what is followed changes evenly.
    struct Knot {
        double age, value;
        double travelled;  ///< integral from the oldest knot to this one
    };
    void add(double age, double value);
    double travelledAt(double age);

    std::array<Knot, 2 * mostPieces + 1> knots_;  ///< the first `count_`, oldest first
    std::size_t count_ = 0;
    std::size_t next_ = 0;                     ///< the newest knot that is as old as what was asked for last, or older
    double lastAge_ = -1, lastTravelled_ = 0;  ///< what was asked for last
};

}  // namespace mrose
