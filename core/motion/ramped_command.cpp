#include "motion/ramped_command.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace mrose {
namespace {

/// `command`, or what is nearest to it no farther than `within` from `from`. Branches would be guessed wrong.
double followed(double from, double command, double within) {
    const double most = from + within, least = from - within;
    const double towards = command < most ? command : most;
    return towards > least ? towards : least;
}

}  // namespace

RampedCommand::RampedCommand(const ActuatorLimits& limits, std::span<const double> ages, const double* commands,
                             std::size_t stride, const Command& begun)
    : ages_(ages), commands_(commands), stride_(stride), accelerations_{limits.accelerationV, limits.accelerationW} {
    const std::size_t pieces = ages.size() - 1;
    assert(pieces > 0 && pieces <= mostPieces);
    for (std::size_t c = 0; c < channels; ++c) {
        halfAccelerations_[c] = 0.5 * accelerations_[c];
        perAccelerations_[c] = accelerations_[c] > 0 ? 1 / accelerations_[c] : 0;
        if (accelerations_[c] == 0) accelerations_[c] = std::numeric_limits<double>::max();
    }
    Channels now{begun.v, begun.w};
    for (std::size_t i = pieces; i-- > 0;) {
        begun_[i] = now;
        const double lasts = ages[i + 1] - ages[i];
        for (std::size_t c = 0; c < channels; ++c)
            now[c] = followed(now[c], commands[i * stride + c], accelerations_[c] * lasts);
    }
}

Command RampedCommand::mean(double newest, double oldest) {
    if (ages_[newest_] > newest) newest_ = 0;
    while (ages_[newest_ + 1] <= newest) ++newest_;
    Channels travelled{};
    double from = newest;
    for (std::size_t i = newest_; from < oldest; ++i) {
        const double to = std::min(ages_[i + 1], oldest);
        const double begun = ages_[i + 1] - to, ended = ages_[i + 1] - from;  // s since the piece's beginning
        for (std::size_t c = 0; c < channels; ++c) {
            const double command = commands_[i * stride_ + c], missing = command - begun_[i][c];
            const double rampEnds = std::abs(missing) * perAccelerations_[c];
            const double halfSlope = std::copysign(halfAccelerations_[c], missing);
            const double a = std::min(begun, rampEnds), b = std::min(ended, rampEnds);
            travelled[c] += command * (to - from) - missing * (b - a) + halfSlope * (b * b - a * a);
        }
        from = to;
    }
    const double perTime = 1 / (oldest - newest);
    return {travelled[0] * perTime, travelled[1] * perTime};
}

Command RampedCommand::at(double age) const {
    std::size_t i = 0;
    while (i + 2 < ages_.size() && ages_[i + 1] <= age) ++i;
    const double since = ages_[i + 1] - age;
    const double* const command = commands_ + i * stride_;
    return {followed(begun_[i][0], command[0], accelerations_[0] * since),
            followed(begun_[i][1], command[1], accelerations_[1] * since)};
}

}  // namespace mrose
