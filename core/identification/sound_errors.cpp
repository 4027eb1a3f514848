#include "identification/sound_errors.h"

#include <algorithm>
#include <cmath>

#include "identification/robust_statistics.h"

namespace mrose {

bool SoundErrors::holds(const ReadingError& error) const {
    for (std::size_t d = 0; d < dimensions; ++d)
        if (!(std::abs(error[d] - median[d]) <= bound[d])) return false;
    return true;
}

SoundErrors soundErrors(const SensorSamples& samples, int dimensions) {
    constexpr double spreads = 10, least = 1e-6;
    SoundErrors sound{static_cast<std::size_t>(dimensions), {}, {}};
    for (std::size_t d = 0; d < sound.dimensions; ++d) {
        std::vector<double> errors;
        samples.visitReadings([&](const SensorCase& one) { errors.push_back(one.error[d]); });
        sound.median[d] = medianOf(errors);
        sound.bound[d] = std::max(spreads * robustSpread(std::move(errors), sound.median[d]), least);
    }
    return sound;
}

GrossErrors grossErrors(const SensorSamples& samples, const SoundErrors& sound) {
    constexpr double farther = 1.5;
    GrossErrors gross;
    for (std::size_t d = 0; d < sound.dimensions; ++d)
        gross.reach[d] = 2 * (std::abs(sound.median[d]) + sound.bound[d]);
    double readings = 0, wrong = 0;
    samples.visitReadings([&](const SensorCase& one) {
        ++readings;
        if (sound.holds(one.error)) return;
        ++wrong;
        for (std::size_t d = 0; d < sound.dimensions; ++d)
            gross.reach[d] = std::max(gross.reach[d], farther * std::abs(one.error[d]));
    });
    gross.share = (wrong + 0.5) / (readings + 1);
    return gross;
}

}  // namespace mrose
