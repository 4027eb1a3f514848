#include "perception/reading_distribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "geometry/normal_distribution.h"

namespace mrose {
namespace {

constexpr double leastSpread = -11.5, mostSpread = 6.9;  // logarithms

/// Shares of the components from their logarithms, the largest of which may be any.
void shares(const ReadingForm& form, const double* values, double* share) {
    double most = 0, sum = 0;
    for (int k = 1; k < form.components; ++k) most = std::max(most, values[form.shareOf(k)]);
    for (int k = 0; k < form.components; ++k) {
        share[k] = exponential((k == 0 ? 0 : values[form.shareOf(k)]) - most);
        sum += share[k];
    }
    for (int k = 0; k < form.components; ++k) share[k] /= sum;
}

double spreadFrom(double logarithm) { return exponential(std::clamp(logarithm, leastSpread, mostSpread)); }

}  // namespace

double GrossErrors::density(int dimensions) const {
    double density = 1;
    for (int d = 0; d < dimensions; ++d) density /= 2 * reach[static_cast<std::size_t>(d)];
    return density;
}

ReadingDistribution ReadingDistribution::of(const ReadingForm& form, std::span<const double> values,
                                            const GrossErrors& gross) {
    assert(static_cast<int>(values.size()) == form.outputs());
    ReadingDistribution result;
    result.dimensions = form.dimensions;
    result.components = form.components;
    result.threshold = values[ReadingForm::reported];
    result.gross = gross;
    double share[ReadingForm::maxComponents];
    shares(form, values.data(), share);
    for (int k = 0; k < form.components; ++k) {
        Component& component = result.component[static_cast<std::size_t>(k)];
        component.share = share[k];
        for (int d = 0; d < form.dimensions; ++d) {
            const auto i = static_cast<std::size_t>(d);
            component.mean[i] = values[static_cast<std::size_t>(form.errorOf(k, d))];
            component.spread[i] = spreadFrom(values[static_cast<std::size_t>(form.spreadOf(k, d))]);
        }
    }
    return result;
}

double ReadingDistribution::probability() const { return normalProbability(threshold); }

double ReadingDistribution::density(const ReadingError& error) const {
    double sum = 0;
    bool within = true;
    for (int k = 0; k < components; ++k) {
        const Component& c = component[static_cast<std::size_t>(k)];
        double density = c.share;
        for (std::size_t d = 0; d < static_cast<std::size_t>(dimensions); ++d)
            density *= normalDensity((error[d] - c.mean[d]) / c.spread[d]) / c.spread[d];
        sum += density;
    }
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimensions); ++d)
        within = within && std::abs(error[d]) <= gross.reach[d];
    return (1 - gross.share) * sum + (within && gross.share > 0 ? gross.share * gross.density(dimensions) : 0);
}

double ReadingDistribution::probabilityBelow(int dimension, double error) const {
    const auto d = static_cast<std::size_t>(dimension);
    double sum = 0;
    for (int k = 0; k < components; ++k) {
        const Component& c = component[static_cast<std::size_t>(k)];
        sum += c.share * normalProbability((error - c.mean[d]) / c.spread[d]);
    }
    if (gross.share == 0) return sum;
    return (1 - gross.share) * sum + gross.share * std::clamp(0.5 + 0.5 * error / gross.reach[d], 0.0, 1.0);
}

double ReadingDistribution::mean(int dimension) const {
    double sum = 0;
    for (int k = 0; k < components; ++k) {
        const Component& c = component[static_cast<std::size_t>(k)];
        sum += c.share * c.mean[static_cast<std::size_t>(dimension)];
    }
    return (1 - gross.share) * sum;
}

double ReadingDistribution::deviation(int dimension) const {
    const auto d = static_cast<std::size_t>(dimension);
    const double average = mean(dimension);
    double sum = 0;
    for (int k = 0; k < components; ++k) {
        const Component& c = component[static_cast<std::size_t>(k)];
        sum += c.share * (c.spread[d] * c.spread[d] + c.mean[d] * c.mean[d]);
    }
    const double even = gross.share > 0 ? gross.share * gross.reach[d] * gross.reach[d] / 3 : 0;
    return std::sqrt((1 - gross.share) * sum + even - average * average);
}

ReadingError ReadingDistribution::error(const ReadingDraw& draw) const {
    ReadingError error{};
    if (draw.which < gross.share) {
        for (std::size_t d = 0; d < static_cast<std::size_t>(dimensions); ++d)
            error[d] = gross.reach[d] * (2 * normalProbability(draw.error[d]) - 1);
        return error;
    }
    double left = (draw.which - gross.share) / (1 - gross.share);
    std::size_t k = 0;
    while (k + 1 < static_cast<std::size_t>(components) && left >= component[k].share) left -= component[k++].share;
    for (std::size_t d = 0; d < static_cast<std::size_t>(dimensions); ++d)
        error[d] = component[k].mean[d] + component[k].spread[d] * draw.error[d];
    return error;
}

double reportLoss(double threshold, bool reported, double* gradient) {
    // of the probability of less than x: the density over it
    const double x = reported ? threshold : -threshold;
    const double slope = normalHazard(-x);
    *gradient = reported ? -slope : slope;
    return -logNormalProbability(x);
}

double errorLoss(const ReadingForm& form, const double* values, const GrossErrors& gross, const ReadingError& error,
                 double* gradient) {
    double share[ReadingForm::maxComponents], part[ReadingForm::maxComponents];
    shares(form, values, share);
    bool within = gross.share > 0;
    for (int d = 0; d < form.dimensions; ++d)
        within = within && std::abs(error[static_cast<std::size_t>(d)]) <= gross.reach[static_cast<std::size_t>(d)];
    double most = within ? logarithm(gross.share * gross.density(form.dimensions)) : -1e300;
    const double grossPart = most;
    for (int k = 0; k < form.components; ++k) {
        part[k] = logarithm((1 - gross.share) * share[k]) - 0.5 * form.dimensions * logarithm(2 * std::numbers::pi);
        for (int d = 0; d < form.dimensions; ++d) {
            const double spread = std::clamp(values[form.spreadOf(k, d)], leastSpread, mostSpread);
            const double z = (error[static_cast<std::size_t>(d)] - values[form.errorOf(k, d)]) * exponential(-spread);
            part[k] -= spread + 0.5 * z * z;
        }
        most = std::max(most, part[k]);
    }
    double sum = within ? exponential(grossPart - most) : 0, proper = 0;
    for (int k = 0; k < form.components; ++k) sum += part[k] = exponential(part[k] - most);
    for (int k = 0; k < form.components; ++k) proper += part[k] /= sum;
    gradient[ReadingForm::reported] = 0;
    for (int k = 0; k < form.components; ++k) {
        if (k > 0) gradient[form.shareOf(k)] = share[k] * proper - part[k];
        for (int d = 0; d < form.dimensions; ++d) {
            const double spread = values[form.spreadOf(k, d)];
            const bool inside = spread > leastSpread && spread < mostSpread;
            const double inverse = exponential(-std::clamp(spread, leastSpread, mostSpread));
            const double z = (error[static_cast<std::size_t>(d)] - values[form.errorOf(k, d)]) * inverse;
            gradient[form.errorOf(k, d)] = -part[k] * z * inverse;
            gradient[form.spreadOf(k, d)] = inside ? -part[k] * (z * z - 1) : 0;
        }
    }
    return -(most + logarithm(sum));
}

}  // namespace mrose
