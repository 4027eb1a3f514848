#include "identification/constant_noise_fit.h"

#include <algorithm>
#include <cmath>

#include "perception/ideal_view.h"

namespace mrose {
namespace {

/// How many of the cases were reported; never none and never all.
struct Share {
    double reported = 0.5, cases = 1;
    void add(bool one) { reported += one, ++cases; }
    double value() const { return reported / cases; }
};

}  // namespace

ConstantNoise fitConstantNoise(const SensorNetwork& sensor, const SensorSamples& samples, const SoundErrors& sound) {
    Share seen, unseen;
    ReadingError squares{};
    double count = 0;
    const auto dimensions = static_cast<std::size_t>(sensor.form.dimensions);
    for (const SampledLook& look : samples.looks)
        for (std::size_t i = look.first; i < look.first + look.count && !look.unknown; ++i) {
            const SensorCase& one = samples.cases[i];
            if (sensor.landmarks && one.state.subject == SubjectKind::robot) continue;
            const bool inView = sensor.measures == SensorNetwork::Measures::pose || ideallySeen(sensor.view, one.state);
            (inView ? seen : unseen).add(one.reported);
            if (!one.reported || !sound.holds(one.error)) continue;
            ++count;
            for (std::size_t d = 0; d < dimensions; ++d) squares[d] += one.error[d] * one.error[d];
        }
    ConstantNoise noise{seen.value(), unseen.value(), {}};
    for (std::size_t d = 0; d < dimensions; ++d)
        noise.spread[d] = std::max(std::sqrt(squares[d] / std::max(count, 1.0)), 1e-6);
    return noise;
}

}  // namespace mrose
