#include "identification/reading_noise_fit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/normal_distribution.h"
#include "learning/parallel_for.h"

namespace mrose {
namespace {

/// A residual r of one reading, with the coefficients by which products of two of them depend on a correlation c:
/// E[r r'] = sum over n of c^n / n! h_n h_n'. It counts by h_0, as its information about small correlations asks for.
struct Residual {
    static constexpr std::size_t terms = 3;

    std::size_t subject = 0;
    double r = 0;
    std::array<double, terms> h{};
};

/// Sums over residuals, and from them sums over pairs of them.
struct ResidualSums {
    double r = 0;
    std::array<double, Residual::terms> h{};

    void add(const Residual& one) {
        r += one.r * one.h[0];
        for (std::size_t n = 0; n < h.size(); ++n) h[n] += one.h[0] * one.h[n];
    }
};

struct PairSums {
    double product = 0;
    std::array<double, Residual::terms> h{};

    void add(const ResidualSums& a, const ResidualSums& b, double times = 1) {
        product += times * a.r * b.r;
        for (std::size_t n = 0; n < h.size(); ++n) h[n] += times * a.h[n] * b.h[n];
    }
    /// The correlation whose series gives the product, by Newton's method from its first term.
    double correlation() const {
        if (!(h[0] > 0)) return 0;
        double c = std::clamp(product / h[0], -0.99, 0.99);
        for (int i = 0; i < 20; ++i) {
            const double value = c * (h[0] + c * (h[1] / 2 + c * h[2] / 6)) - product;
            const double slope = h[0] + c * (h[1] + c * h[2] / 2);
            if (!(slope > 0.1 * h[0])) break;
            c = std::clamp(c - value / slope, -0.99, 0.99);
        }
        return c;
    }
};

/// Of one channel.
struct LookResiduals {
    std::vector<Residual> all;
    ResidualSums sum;

    void add(const Residual& one) {
        all.push_back(one);
        sum.add(one);
    }
};
using ChannelResiduals = std::vector<LookResiduals>;  // by look

std::array<ChannelResiduals, readingChannels> residualsOf(const LearnedSensor& sensor, const SensorSamples& samples) {
    const int dimensions = sensor.network().form.dimensions;
    const bool ofSubjects = sensor.network().measures == SensorNetwork::Measures::subjects;
    std::array<ChannelResiduals, readingChannels> channels;
    for (ChannelResiduals& channel : channels) channel.resize(samples.looks.size());
    parallelFor(samples.looks.size(), [&](std::size_t l) {
        const SampledLook& look = samples.looks[l];
        if (look.unknown) return;
        std::vector<SensedState> states;
        for (std::size_t i = 0; i < look.count; ++i) states.push_back(samples.cases[look.first + i].state);
        std::vector<ReadingDistribution> distributions(states.size());
        sensor.distributions(states, look.robot, distributions);
        for (std::size_t i = 0; i < look.count; ++i) {
            const ReadingDistribution& distribution = distributions[i];
            const SensorCase& one = samples.cases[look.first + i];
            const double p = distribution.probability(), a = distribution.threshold;
            const double density = normalDensity(a);
            // Poses are of no subject: what they have in common is common to all.
            const std::size_t subject = ofSubjects ? one.subject : l;
            if (p > 0.01 && p < 0.99)
                channels[0][l].add({subject, one.reported - p, {density, -a * density, (a * a - 1) * density}});
            if (!one.reported) continue;
            for (int d = 0; d < dimensions; ++d) {
                const double below = distribution.probabilityBelow(d, one.error[static_cast<std::size_t>(d)]);
                if (below < 1e-4 || below > 1 - 1e-4) continue;  // a gross error is that reading's alone
                channels[1 + static_cast<std::size_t>(d)][l].add({subject, normalQuantile(below), {1, 0, 0}});
            }
        }
    });
    return channels;
}

/// Of readings of one look: of different subjects.
double withinLooks(const ChannelResiduals& channel) {
    PairSums pairs;
    for (const LookResiduals& look : channel) {
        pairs.add(look.sum, look.sum, 0.5);
        for (const Residual& one : look.all) {
            ResidualSums own;
            own.add(one);
            pairs.add(own, own, -0.5);
        }
    }
    return pairs.correlation();
}

/// Correlations by how far two looks of a robot lie apart.
struct Lagged {
    double seconds = 0, correlation = 0, weight = 0;
};
struct LaggedKinds {
    std::vector<Lagged> different, same;  ///< subjects
};

LaggedKinds acrossLooks(const ChannelResiduals& channel, const SensorSamples& samples) {
    constexpr double bin = 0.2, longest = 20;  // s
    struct Bin {
        PairSums different, same;
        double seconds = 0, pairs = 0;
    };
    std::vector<Bin> bins(static_cast<std::size_t>(longest / bin) + 1);
    for (std::size_t i = 0; i < channel.size(); ++i)
        for (std::size_t j = i + 1; j < channel.size() && !channel[i].all.empty(); ++j) {
            const SampledLook &a = samples.looks[i], &b = samples.looks[j];
            const double apart = toSeconds(b.time - a.time);
            if (b.robot != a.robot || b.log != a.log || apart < 0 || apart > longest) break;
            if (channel[j].all.empty()) continue;
            Bin& at = bins[static_cast<std::size_t>(apart / bin)];
            at.different.add(channel[i].sum, channel[j].sum);
            for (const Residual& x : channel[i].all)
                for (const Residual& y : channel[j].all) {
                    if (x.subject != y.subject) continue;
                    ResidualSums one, other;
                    one.add(x);
                    other.add(y);
                    at.same.add(one, other);
                    at.different.add(one, other, -1);
                }
            at.seconds += apart;
            ++at.pairs;
        }
    LaggedKinds lags;
    for (const Bin& at : bins) {
        if (at.pairs < 100) continue;
        lags.different.push_back({at.seconds / at.pairs, at.different.correlation(), at.different.h[0]});
        lags.same.push_back({at.seconds / at.pairs, at.same.correlation(), at.same.h[0]});
    }
    return lags;
}

struct LastingPart {
    double share = 0, time = 1;
};

/// The exponential that comes nearest to the correlations.
LastingPart lastingPart(const std::vector<Lagged>& lags) {
    LastingPart best;
    double least = 0;
    for (const Lagged& lag : lags) least += lag.weight * lag.correlation * lag.correlation;
    constexpr int times = 53;  // from 0.2 to 30 s
    for (int i = 0; i < times; ++i) {
        const double time = 0.2 * power(1.1, i);
        double product = 0, square = 0, error = 0;
        for (const Lagged& lag : lags) {
            const double left = decay(lag.seconds / time);
            product += lag.weight * left * lag.correlation;
            square += lag.weight * left * left;
        }
        const double share = square > 0 ? std::clamp(product / square, 0.0, 0.98) : 0;
        for (const Lagged& lag : lags) {
            const double off = lag.correlation - share * decay(lag.seconds / time);
            error += lag.weight * off * off;
        }
        if (error >= least) continue;
        least = error;
        best = {share, time};
    }
    return best;
}

ReadingNoise noiseOf(const ChannelResiduals& channel, const SensorSamples& samples) {
    LaggedKinds lags = acrossLooks(channel, samples);
    const LastingPart slow = lastingPart(lags.different);
    for (Lagged& lag : lags.same) lag.correlation -= slow.share * decay(lag.seconds / slow.time);
    LastingPart subject = lastingPart(lags.same);
    subject.share = std::min(subject.share, 0.98 - slow.share);
    const double look = std::clamp(withinLooks(channel) - slow.share, 0.0, 0.98 - slow.share - subject.share);
    return {look, slow.share, slow.time, subject.share, subject.time};
}

}  // namespace

ReadingNoises fitReadingNoises(const LearnedSensor& sensor, const SensorSamples& samples) {
    const auto channels = residualsOf(sensor, samples);
    ReadingNoises noises;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(sensor.network().form.dimensions); ++i)
        noises[i] = noiseOf(channels[i], samples);
    return noises;
}

}  // namespace mrose
