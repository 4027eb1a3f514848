#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/elementary.h"
#include "perception/reading_distribution.h"

namespace mrose {

/// What readings have in common: the standard normal number behind one channel of a reading (whether there is one, or
/// the error of a dimension) is a sum of independent parts, by their shares of the variance. Parts that last are
/// first-order autoregressive processes. What is left is each reading's alone.
struct ReadingNoise {
    double look = 0;         ///< the same for all readings of one look
    double slow = 0;         ///< the same for all readings, and lasts
    double slowTime = 1;     ///< s: after it 1/e of that is left
    double subject = 0;      ///< the same for all readings of one subject, and lasts
    double subjectTime = 1;  ///< s
    bool operator==(const ReadingNoise&) const = default;

    double alone() const { return std::max(0.0, 1 - look - slow - subject); }
};

/// Channels: first whether there is a reading, then its errors by dimension.
inline constexpr std::size_t readingChannels = 1 + ReadingForm::maxDimensions;
using ReadingNoises = std::array<ReadingNoise, readingChannels>;
using ChannelNumbers = std::array<double, readingChannels>;

/// How a part that lasts goes on: in its exact discretisation, standard normal itself if it was before.
struct Lasting {
    double kept = 0, added = 1;  ///< by default as one that begins

    static Lasting after(double seconds, double time) {
        const double kept = decay(seconds / time);
        return {kept, std::sqrt(1 - kept * kept)};
    }
    /// From a new standard normal number.
    double next(double before, double normal) const { return kept * before + added * normal; }
};

/// The parts' standard deviations.
struct NoiseWeights {
    explicit NoiseWeights(const ReadingNoises& noises) {
        for (std::size_t i = 0; i < noises.size(); ++i) {
            look[i] = std::sqrt(noises[i].look);
            slow[i] = std::sqrt(noises[i].slow);
            subject[i] = std::sqrt(noises[i].subject);
            alone[i] = std::sqrt(noises[i].alone());
        }
    }
    ChannelNumbers look, slow, subject, alone;
};

}  // namespace mrose
