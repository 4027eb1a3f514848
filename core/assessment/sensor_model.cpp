#include "assessment/sensor_model.h"

#include <algorithm>

#include "geometry/normal_distribution.h"
#include "perception/ideal_view.h"

namespace mrose {
namespace {

// The quantiles of a probability that is as good as 0, and of its complement.
constexpr double never = -38, always = 38;

double quantileOf(double probability) {
    return probability <= 0 ? never : probability >= 1 ? always : normalQuantile(probability);
}

}  // namespace

void LearnedSensorModel::distributions(std::span<const SensedState> states, const std::string& robot,
                                       std::span<ReadingDistribution> to) const {
    sensor_.distributions(states, sensor_.robotIndex(robot), to);
    for (std::size_t i = 0; i < states.size(); ++i)
        if (!sensor_.inView(states[i])) to[i].threshold = never;
}

IdealSensorModel::IdealSensorModel(const SensorNetwork& like, Noise noise)
    : latency_(like.latency), view_(like.view), pose_(like.measures == SensorNetwork::Measures::pose) {
    const bool noisy = noise == Noise::constant;
    seen_.form.dimensions = like.form.dimensions;
    if (noisy) seen_.gross = like.gross;
    for (std::size_t d = 0; d < ReadingForm::maxDimensions; ++d)
        seen_.component[0].spread[d] = std::max(noisy ? like.constant.spread[d] : 0, 1e-9);
    unseen_ = seen_;
    seen_.threshold = noisy ? quantileOf(like.constant.seen) : always;
    unseen_.threshold = noisy ? quantileOf(like.constant.unseen) : never;
}

void IdealSensorModel::distributions(std::span<const SensedState> states, const std::string&,
                                     std::span<ReadingDistribution> to) const {
    for (std::size_t i = 0; i < states.size(); ++i) to[i] = pose_ || ideallySeen(view_, states[i]) ? seen_ : unseen_;
}

}  // namespace mrose
