#include "perception/reading_distribution.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "geometry/normal_distribution.h"

namespace mrose {
namespace {

constexpr double leastSpread = -11.5, mostSpread = 6.9;  // logarithms
constexpr double logTwoPi = 1.8378770664093453;          // known here: every reading that is learned from needs it

/// exponential() of |x| <= 700. Without a branch, and without making an integer of the exponent, compilers compute
/// several at once.
inline double exponentialNear(double x) {
    const elementary::Exponent e(x);
    const auto whole = std::bit_cast<std::uint64_t>(e.whole + 0x1.8p52);
    return (1 + e.beyond) * std::bit_cast<double>((whole + 1023) << 52);
}

/// What shares were divided by: sum exp(most).
struct Divisor {
    double most = 0, sum = 0;
};

/// Shares of the components from their logarithms, the largest of which may be any.
Divisor shares(const ReadingForm& form, const double* values, double* share) {
    double most = 0, sum = 0;
    for (int k = 1; k < form.components; ++k) most = std::max(most, values[form.shareOf(k)]);
    for (int k = 0; k < form.components; ++k) {
        share[k] = exponential((k == 0 ? 0 : values[form.shareOf(k)]) - most);
        sum += share[k];
    }
    for (int k = 0; k < form.components; ++k) share[k] /= sum;
    return {most, sum};
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
    const LogProbability of = logProbabilityAndSlope(reported ? threshold : -threshold);
    *gradient = reported ? -of.slope : of.slope;
    return -of.value;
}

double errorLoss(const ReadingForm& form, const double* values, const GrossErrors& gross, const ReadingError& error,
                 double* gradient) {
    constexpr int mostComponents = ReadingForm::maxComponents;
    constexpr int mostCells = mostComponents * ReadingForm::maxDimensions;
    const int dimensions = form.dimensions, components = form.components, cells = components * dimensions;
    // by component and dimension
    double spread[mostCells], inverse[mostCells], z[mostCells];
    for (int k = 0, c = 0; k < components; ++k)
        for (int d = 0; d < dimensions; ++d, ++c) {
            spread[c] = std::clamp(values[form.spreadOf(k, d)], leastSpread, mostSpread);
            z[c] = error[static_cast<std::size_t>(d)] - values[form.errorOf(k, d)];
        }
    for (int c = 0; c < cells; ++c) {
        inverse[c] = exponentialNear(-spread[c]);
        z[c] *= inverse[c];
    }
    double share[mostComponents], part[mostComponents];  // of the density: logarithms, then shares
    const Divisor of = shares(form, values, share);
    const double common = logarithm((1 - gross.share) / of.sum) - of.most - 0.5 * dimensions * logTwoPi;
    bool within = gross.share > 0;
    for (int d = 0; d < dimensions; ++d)
        within = within && std::abs(error[static_cast<std::size_t>(d)]) <= gross.reach[static_cast<std::size_t>(d)];
    const double grossPart = within ? logarithm(gross.share * gross.density(dimensions)) : -1e300;
    double largest = grossPart;
    for (int k = 0; k < components; ++k) {
        part[k] = common + (k == 0 ? 0 : values[form.shareOf(k)]);
        for (int c = k * dimensions; c < (k + 1) * dimensions; ++c) part[k] -= spread[c] + 0.5 * z[c] * z[c];
        largest = std::max(largest, part[k]);
    }
    double sum = 0, proper = 0;
    for (int k = 0; k < components; ++k) part[k] = exponentialNear(std::max(part[k] - largest, -700.0));
    for (int k = 0; k < components; ++k) sum += part[k];
    if (within) sum += exponential(grossPart - largest);
    for (int k = 0; k < components; ++k) proper += part[k] /= sum;
    for (int k = 0, c = 0; k < components; ++k) {
        if (k > 0) gradient[form.shareOf(k)] = share[k] * proper - part[k];
        for (int d = 0; d < dimensions; ++d, ++c) {
            const double asked = values[form.spreadOf(k, d)];
            const bool inside = asked > leastSpread && asked < mostSpread;
            gradient[form.errorOf(k, d)] = -part[k] * z[c] * inverse[c];
            gradient[form.spreadOf(k, d)] = inside ? -part[k] * (z[c] * z[c] - 1) : 0;
        }
    }
    return -(largest + logarithm(sum));
}

}  // namespace mrose
