#include "motion/residual_noise.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "geometry/elementary.h"
#include "geometry/normal_distribution.h"

namespace mrose {
namespace {

using Quantity = NetworkInput::Quantity;

constexpr std::size_t drawsPerKey = 8;

NoiseTraits unbounded() {
    NoiseTraits traits;
    traits.fill(std::numeric_limits<double>::infinity());
    return traits;
}

}  // namespace

NoiseTraitReader::NoiseTraitReader(const MotionNetwork& network) : period_(toSeconds(network.period)) {
    for (std::size_t i = 0; i + 1 < network.inputs.size(); ++i) {
        const NetworkInput &one = network.inputs[i], &next = network.inputs[i + 1];
        if (one.quantity != next.quantity) continue;
        const Neighbours neighbours{i, one.scale, -next.scale, one.mean - next.mean};
        if (one.quantity == Quantity::commandV) v_.push_back(neighbours);
        if (one.quantity == Quantity::commandW) w_.push_back(neighbours);
    }
}

NoiseTraits NoiseTraitReader::read(const float* row, const Pose& increment, const Pose& previous) const {
    constexpr double little = 0.005, reach = 0.1;  // m/s, m: what a rotation moves that is as much as a distance
    const auto unevenness = [&](const std::vector<Neighbours>& inputs) {
        double sum = 0;
        for (const Neighbours& n : inputs)
            sum += std::abs(n.first * static_cast<double>(row[n.input]) +
                            n.second * static_cast<double>(row[n.input + 1]) + n.constant);
        return sum * period_;
    };
    const double motion = std::abs(increment.x) + reach * std::abs(increment.heading);
    return {motion / (motion + little * period_),
            std::abs(increment.x),
            std::abs(increment.heading),
            unevenness(v_),
            unevenness(w_),
            increment.x,
            increment.x - previous.x,
            increment.heading - previous.heading};
}

NoiseProcesses::NoiseProcesses(const ResidualNoise& noise, std::size_t members, double period)
    : noise_(noise),
      most_(noise.most.value_or(unbounded())),
      members_(noise.members.weight == 0 || members < 2 ? 0 : members),
      perMember_(members_ == 0 ? 0 : noise.members.weight / std::sqrt(static_cast<double>(members_ - 1))) {
    const auto add = [&](double time) {
        const double kept = time > 0 ? decay(period / time) : 0;
        decays_.push_back(kept);
        renewals_.push_back(std::sqrt(1 - kept * kept));
    };
    for (const ResidualNoise::Process& process : noise_.processes) add(process.time);
    for (std::size_t m = 0; m < members_; ++m) add(noise_.members.time);
    add(noise_.scale.time);
}

void NoiseProcesses::advance(const NoiseKey& key, bool begun, std::span<float> values) const {
    assert(values.size() == this->values());
    NoiseKey own = key;
    for (std::size_t first = 0; first < values.size(); first += drawsPerKey, ++own.channel) {
        const UniformDraws uniform(own);
        std::array<double, drawsPerKey> draws;
        for (std::size_t i = 0; i < drawsPerKey; ++i) draws[i] = uniform[i];
        draws = drawnNormals(draws);
        const std::size_t count = std::min(drawsPerKey, values.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t at = first + i;
            const double value =
                begun ? decays_[at] * static_cast<double>(values[at]) + renewals_[at] * draws[i] : draws[i];
            values[at] = static_cast<float>(value);
        }
    }
}

Pose NoiseProcesses::noise(std::span<const float> values, const NoiseTraits& traits,
                           std::span<const Pose> members) const {
    std::array<double, 3> sums{};
    for (std::size_t i = 0; i < noise_.processes.size(); ++i) {
        const ResidualNoise::Process& process = noise_.processes[i];
        double amplitude = 0;
        for (const ResidualNoise::Share& share : process.amplitude) {
            const auto trait = static_cast<std::size_t>(share.trait);
            amplitude += share.weight * std::clamp(traits[trait], -most_[trait], most_[trait]);
        }
        sums[static_cast<std::size_t>(process.axis)] += amplitude * static_cast<double>(values[i]);
    }
    assert(members_ == 0 || members.size() == members_);
    for (std::size_t m = 0; m < members_; ++m) {
        const double weight = perMember_ * static_cast<double>(values[noise_.processes.size() + m]);
        sums[0] += weight * members[m].x;
        sums[1] += weight * members[m].y;
        sums[2] += weight * members[m].heading;
    }
    const double all = scale(values);
    return {all * sums[0], all * sums[1], all * sums[2]};
}

double NoiseProcesses::scale(std::span<const float> values) const {
    return exponential(noise_.scale.weight * static_cast<double>(values.back()));
}

}  // namespace mrose
