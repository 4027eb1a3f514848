#include "tasks/output_contrasts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mrose {

OutputContrasts::OutputContrasts(std::span<const float> standardised, std::span<const NetworkVariable> outputs) {
    for (const NetworkVariable& output : outputs) scales_.push_back(output.scale);
    spreads_.assign(count(), 0);
    const std::size_t rows = standardised.size() / outputs.size();
    for (std::size_t row = 0; row < rows; ++row) {
        const std::vector<double> all = differences(&standardised[row * outputs.size()]);
        for (std::size_t k = 0; k < count(); ++k) spreads_[k] += all[k] * all[k];
    }
    for (double& spread : spreads_) spread = std::max(1e-9, std::sqrt(spread / static_cast<double>(rows)));
}

/// The mean of all outputs, then each one's difference from it, in their own unit; standardised ones have the mean 0.
std::vector<double> OutputContrasts::differences(const float* row) const {
    std::vector<double> all(count());
    for (std::size_t k = 0; k < outputs(); ++k) all[k + 1] = scales_[k] * static_cast<double>(row[k]);
    all[0] = std::accumulate(all.begin() + 1, all.end(), 0.0) / static_cast<double>(outputs());
    for (std::size_t k = 1; k < count(); ++k) all[k] -= all[0];
    return all;
}

std::vector<float> OutputContrasts::of(std::span<const float> standardised) const {
    std::vector<float> all;
    for (std::size_t row = 0; row < standardised.size(); row += outputs()) {
        const std::vector<double> values = differences(&standardised[row]);
        for (std::size_t k = 0; k < count(); ++k) all.push_back(static_cast<float>(values[k] / spreads_[k]));
    }
    return all;
}

Mlp OutputContrasts::undone(const Mlp& network) const {
    const auto hidden = static_cast<std::size_t>(network.shape.hidden);
    const std::size_t first = hidden * (static_cast<std::size_t>(network.shape.inputs) + 1);
    Mlp result{{network.shape.inputs, network.shape.hidden, static_cast<int>(outputs())},
               {network.parameters.begin(), network.parameters.begin() + static_cast<std::ptrdiff_t>(first)}};
    const auto add = [&](std::size_t mean, std::size_t own, std::size_t k) {
        const double value = spreads_[0] * static_cast<double>(network.parameters[mean]) +
                             spreads_[k + 1] * static_cast<double>(network.parameters[own]);
        result.parameters.push_back(static_cast<float>(value / scales_[k]));
    };
    for (std::size_t k = 0; k < outputs(); ++k)
        for (std::size_t i = 0; i < hidden; ++i) add(first + i, first + (k + 1) * hidden + i, k);
    const std::size_t biases = first + count() * hidden;
    for (std::size_t k = 0; k < outputs(); ++k) add(biases, biases + k + 1, k);
    return result;
}

}  // namespace mrose
