#include "assessment/kick_scores.h"

#include <cmath>

#include "assessment/reading_scores.h"
#include "geometry/normal_distribution.h"
#include "geometry/pose.h"

namespace mrose {
namespace {

/// What is predicted of one kick.
struct PredictedKick {
    ReadingDistribution delay, departure;
};

/// One normal distribution.
ReadingDistribution normalAbout(const std::vector<double>& means, const std::vector<double>& spreads) {
    ReadingDistribution predicted;
    predicted.form = {static_cast<int>(means.size()), 1, 1};
    for (std::size_t d = 0; d < means.size(); ++d) {
        predicted.component[0].mean[d] = means[d];
        predicted.component[0].spread[d] = spreads[d];
    }
    return predicted;
}

/// `point`: of no width.
PredictedKick analyticKick(const KickNetwork& network, const KickSample& kick, bool point) {
    const KickNetwork::Constant& c = network.constant;
    const double own = kick.state.robot.v * cosine(network.direction);
    const auto wide = [&](double spread) { return point ? 1e-9 : spread; };
    PredictedKick predicted{
        normalAbout({c.deadTime}, {wide(c.delaySpread)}),
        normalAbout({own + kick.state.power * c.speedAtFull, 0}, {wide(c.speedSpread), wide(c.directionSpread)})};
    predicted.departure.threshold = normalQuantile(std::clamp(c.hits, 1e-3, 1 - 1e-3));
    return predicted;
}

void add(KickScores::Quantity& scores, const ReadingDistribution& predicted, int dimension, double happened) {
    scores.crps += rankedProbabilityScore(predicted, dimension, happened);
    const double below = std::abs(predicted.probabilityBelow(dimension, happened) - 0.5);
    scores.inside50 += below <= 0.25 ? 1 : 0;
    scores.inside90 += below <= 0.45 ? 1 : 0;
}

template <class Predict>
KickScores scored(std::string name, std::span<const KickSample> kicks, double direction, bool point,
                  const Predict& predict) {
    KickScores scores{.name = std::move(name), .kicks = kicks.size()};
    for (const KickSample& kick : kicks) {
        const PredictedKick predicted = predict(kick);
        const double hit = predicted.departure.threshold;
        scores.hit += logNormalProbability(kick.hit ? hit : -hit) / static_cast<double>(kicks.size());
        if (!kick.hit) continue;
        ++scores.hits;
        const double turned = wrapAngle(kick.direction - direction);
        add(scores.quantities[0], predicted.delay, 0, kick.delay);
        add(scores.quantities[1], predicted.departure, 0, kick.speed);
        add(scores.quantities[2], predicted.departure, 1, turned);
        scores.delay += logarithm(std::max(1e-300, predicted.delay.density({kick.delay})));
        scores.departure += logarithm(std::max(1e-300, predicted.departure.density({kick.speed, turned})));
    }
    const auto n = static_cast<double>(scores.hits);
    for (KickScores::Quantity& of : scores.quantities) of = {of.crps / n, of.inside50 / n, of.inside90 / n};
    scores.delay = point ? -INFINITY : scores.delay / n;
    scores.departure = point ? -INFINITY : scores.departure / n;
    return scores;
}

}  // namespace

std::vector<KickScores> scoreKicks(const LearnedKicker& kicker, std::span<const KickSample> kicks,
                                   const std::string& name) {
    const KickNetwork& network = kicker.network();
    const double direction = network.direction;
    const auto learned = [&](const KickSample& kick) {
        return PredictedKick{kicker.delay(kick.commanded()), kicker.departure(kick.state)};
    };
    const auto analytic = [&](bool point) {
        return [&network, point](const KickSample& kick) { return analyticKick(network, kick, point); };
    };
    return {scored(name, kicks, direction, false, learned),
            scored("analytic plus noise", kicks, direction, false, analytic(false)),
            scored("analytic", kicks, direction, true, analytic(true))};
}

}  // namespace mrose
