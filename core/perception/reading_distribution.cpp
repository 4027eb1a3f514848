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

/// Which of some, by their shares and a number in [0, 1).
template <class ShareOf>
int chosen(int count, double which, const ShareOf& shareOf) {
    int k = 0;
    while (k + 1 < count && which >= shareOf(k)) which -= shareOf(k++);
    return k;
}

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
    result.form = form;
    result.threshold = values[ReadingForm::reported];
    result.gross = gross;
    Component* component = result.component.data();
    for (int m = 0; m < form.members; ++m) {
        const double* const own = values.data() + ReadingForm::errors + m * form.memberOutputs();
        double share[ReadingForm::maxComponents];
        shares(form, own, share);
        for (int k = 0; k < form.components; ++k, ++component) {
            component->share = share[k];
            for (int d = 0; d < form.dimensions; ++d) {
                const auto i = static_cast<std::size_t>(d);
                component->mean[i] = own[form.errorOf(k, d)];
                component->spread[i] = spreadFrom(own[form.spreadOf(k, d)]);
            }
        }
    }
    return result;
}

double ReadingDistribution::probability() const { return normalProbability(threshold); }

double ReadingDistribution::density(const ReadingError& error) const {
    const auto dimensions = static_cast<std::size_t>(form.dimensions);
    double sum = 0;
    bool within = true;
    for (const Component& c : components()) {
        double density = shareOf(c);
        for (std::size_t d = 0; d < dimensions; ++d)
            density *= normalDensity((error[d] - c.mean[d]) / c.spread[d]) / c.spread[d];
        sum += density;
    }
    for (std::size_t d = 0; d < dimensions; ++d) within = within && std::abs(error[d]) <= gross.reach[d];
    return (1 - gross.share) * sum + (within && gross.share > 0 ? gross.share * gross.density(form.dimensions) : 0);
}

double ReadingDistribution::probabilityBelow(int dimension, double error) const {
    const auto d = static_cast<std::size_t>(dimension);
    double sum = 0;
    for (const Component& c : components()) sum += shareOf(c) * normalProbability((error - c.mean[d]) / c.spread[d]);
    if (gross.share == 0) return sum;
    return (1 - gross.share) * sum + gross.share * std::clamp(0.5 + 0.5 * error / gross.reach[d], 0.0, 1.0);
}

double ReadingDistribution::mean(int dimension) const {
    double sum = 0;
    for (const Component& c : components()) sum += shareOf(c) * c.mean[static_cast<std::size_t>(dimension)];
    return (1 - gross.share) * sum;
}

double ReadingDistribution::deviation(int dimension) const {
    const auto d = static_cast<std::size_t>(dimension);
    const double average = mean(dimension);
    double sum = 0;
    for (const Component& c : components()) sum += shareOf(c) * (c.spread[d] * c.spread[d] + c.mean[d] * c.mean[d]);
    const double even = gross.share > 0 ? gross.share * gross.reach[d] * gross.reach[d] / 3 : 0;
    return std::sqrt((1 - gross.share) * sum + even - average * average);
}

ReadingError ReadingDistribution::error(const ReadingDraw& draw) const {
    const MemberDraw of = memberOf(draw, form, gross);
    if (of.member < 0) return grossError(form, gross, draw);
    const Component* const own = component.data() + of.member * form.components;
    const int k = chosen(form.components, of.which, [&](int i) { return own[i].share; });
    ReadingError error{};
    for (std::size_t d = 0; d < static_cast<std::size_t>(form.dimensions); ++d)
        error[d] = own[k].mean[d] + own[k].spread[d] * draw.error[d];
    return error;
}

MemberDraw memberOf(const ReadingDraw& draw, const ReadingForm& form, const GrossErrors& gross) {
    if (draw.which < gross.share) return {-1, 0};
    const double place = form.members * ((draw.which - gross.share) / (1 - gross.share));
    const int member = std::min(static_cast<int>(place), form.members - 1);
    return {member, place - member};
}

ReadingError memberError(const ReadingForm& form, const double* values, const ReadingDraw& draw, double which) {
    double share[ReadingForm::maxComponents];
    shares(form, values, share);
    const int k = chosen(form.components, which, [&](int i) { return share[i]; });
    ReadingError error{};
    for (int d = 0; d < form.dimensions; ++d)
        error[static_cast<std::size_t>(d)] = values[form.errorOf(k, d)] + spreadFrom(values[form.spreadOf(k, d)]) *
                                                                              draw.error[static_cast<std::size_t>(d)];
    return error;
}

ReadingError grossError(const ReadingForm& form, const GrossErrors& gross, const ReadingDraw& draw) {
    ReadingError error{};
    for (std::size_t d = 0; d < static_cast<std::size_t>(form.dimensions); ++d)
        error[d] = gross.reach[d] * (2 * normalProbability(draw.error[d]) - 1);
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
