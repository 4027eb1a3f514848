#include "assessment/localiser_scores.h"

#include <algorithm>
#include <cmath>

#include "assessment/reading_scores.h"
#include "learning/parallel_for.h"

namespace mrose {
namespace {

/// Of one instant; all but the first only of a sound pose.
struct InstantScore {
    double detection = 0, logDensity = 0;
    std::array<double, LocaliserScores::dimensions> crps{}, miss{}, below{};
};

InstantScore scoreInstant(const SensorModel& model, const LocaliserCase& one) {
    ReadingDistribution predicted;
    model.distributions({&one.state, 1}, one.robot, {&predicted, 1});
    InstantScore score;
    score.detection = reportLogLikelihood(predicted.probability(), one.reported);
    if (!one.sound) return score;
    score.logDensity = errorLogDensity(predicted, one.error);
    for (std::size_t d = 0; d < LocaliserScores::dimensions; ++d) {
        const int dimension = static_cast<int>(d);
        score.crps[d] = rankedProbabilityScore(predicted, dimension, one.error[d]);
        score.miss[d] = one.error[d] - errorQuantile(predicted, dimension, 0.5);
        score.below[d] = predicted.probabilityBelow(dimension, one.error[d]);
    }
    return score;
}

}  // namespace

LocaliserScores scoreLocaliser(const std::string& name, const SensorModel& model,
                               std::span<const LocaliserCase> cases) {
    std::vector<InstantScore> instants(cases.size());
    parallelFor(cases.size(), [&](std::size_t i) { instants[i] = scoreInstant(model, cases[i]); });
    LocaliserScores scores;
    scores.name = name;
    scores.cases = cases.size();
    std::array<ErrorScoreSum, LocaliserScores::dimensions> sums;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const InstantScore& one = instants[i];
        scores.readings += cases[i].reported;
        scores.detection += one.detection;
        if (!cases[i].sound) continue;
        ++scores.sound;
        scores.logDensity += one.logDensity;
        for (std::size_t d = 0; d < LocaliserScores::dimensions; ++d) {
            sums[d].add(one.crps[d], one.miss[d], one.below[d]);
            constexpr std::size_t parts = LocaliserScores::belowParts;
            ++scores.below[d][std::min(static_cast<std::size_t>(one.below[d] * parts), parts - 1)];
        }
    }
    for (std::size_t d = 0; d < LocaliserScores::dimensions; ++d) scores.error[d] = sums[d].mean();
    scores.logDensity /= static_cast<double>(scores.sound);
    scores.detection /= static_cast<double>(scores.cases);
    return scores;
}

}  // namespace mrose
