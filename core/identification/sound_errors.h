#pragma once

#include "identification/sensor_samples.h"
#include "perception/reading_distribution.h"

namespace mrose {

/// Which errors of a sensor are sound, and not gross: in each dimension within ten times what the middle half of all
/// would make the standard deviation, about their median.
struct SoundErrors {
    std::size_t dimensions = 0;
    ReadingError median{}, bound{};

    bool holds(const ReadingError& error) const;
};
/// Of the samples' readings, at least one.
SoundErrors soundErrors(const SensorSamples& samples, int dimensions);

/// How many are gross, and how far off one may be: half as far again as any was.
GrossErrors grossErrors(const SensorSamples& samples, const SoundErrors& sound);

}  // namespace mrose
