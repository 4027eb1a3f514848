#include "assessment/error_bands.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "assessment/metrics.h"
#include "assessment/reading_scores.h"
#include "learning/parallel_for.h"

namespace mrose {
namespace {

constexpr std::size_t fewest = 20;

double stepOf(BandAxis axis) { return axis == BandAxis::range ? 0.5 : 5 * std::numbers::pi / 180; }

/// The error of which a share is less, of all these readings together.
double commonQuantile(std::span<const std::size_t> readings, std::span<const CasePrediction> predictions,
                      std::size_t dimension, double share) {
    const int d = static_cast<int>(dimension);
    double low = INFINITY, high = -INFINITY;
    for (const std::size_t i : readings) {
        const double quantile = errorQuantile(predictions[i].distribution, d, share);
        low = std::min(low, quantile);
        high = std::max(high, quantile);
    }
    while (high - low > 1e-5) {
        const double middle = 0.5 * (low + high);
        double below = 0;
        for (const std::size_t i : readings) below += predictions[i].distribution.probabilityBelow(d, middle);
        (below < share * static_cast<double>(readings.size()) ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

std::vector<ErrorBand> errorBands(std::span<const LoggedCase> cases, std::span<const CasePrediction> predictions,
                                  std::size_t dimension, BandAxis axis) {
    const double step = stepOf(axis);
    std::map<int, std::vector<std::size_t>> parts;
    for (std::size_t i = 0; i < cases.size(); ++i)
        if (cases[i].sound)
            parts[static_cast<int>(std::floor((axis == BandAxis::range ? cases[i].range : cases[i].bearing) / step))]
                .push_back(i);
    std::erase_if(parts, [](const auto& part) { return part.second.size() < fewest; });
    std::vector<ErrorBand> bands;
    std::vector<std::span<const std::size_t>> readings;
    for (const auto& [part, members] : parts) {
        bands.push_back({part * step, (part + 1) * step, members.size()});
        readings.emplace_back(members);
    }
    parallelFor(bands.size(), [&](std::size_t b) {
        std::vector<double> errors;
        for (const std::size_t i : readings[b]) errors.push_back(predictions[i].errorOf(cases[i])[dimension]);
        for (std::size_t s = 0; s < bandShares.size(); ++s) {
            bands[b].real[s] = quantile(errors, bandShares[s]);
            bands[b].predicted[s] = commonQuantile(readings[b], predictions, dimension, bandShares[s]);
        }
    });
    return bands;
}

}  // namespace mrose
