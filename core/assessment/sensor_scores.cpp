#include "assessment/sensor_scores.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assessment/reading_scores.h"
#include "geometry/elementary.h"
#include "geometry/pose.h"

namespace mrose {
namespace {

// Beyond it a distribution is a point, which has no density.
constexpr double leastSpread = 1e-7;

std::vector<CalibrationGroup> groupsOf(std::span<const LoggedCase> cases, std::span<const CaseScore> scores,
                                       std::vector<std::size_t> chosen) {
    std::ranges::stable_sort(chosen, {}, [&](std::size_t i) { return scores[i].probability; });
    const std::size_t count = std::min(calibrationGroups, chosen.size());
    std::vector<CalibrationGroup> groups(count);
    // the first ones are one larger where the division leaves a rest
    std::size_t next = 0;
    for (std::size_t g = 0; g < count; ++g) {
        CalibrationGroup& group = groups[g];
        group.cases = chosen.size() / count + (g < chosen.size() % count);
        for (std::size_t k = 0; k < group.cases; ++k, ++next) {
            group.predicted += scores[chosen[next]].probability;
            group.reported += cases[chosen[next]].reported;
        }
        group.predicted /= static_cast<double>(group.cases);
        group.reported /= static_cast<double>(group.cases);
    }
    return groups;
}

}  // namespace

void ErrorScoreSum::add(double crps, double miss, double below) {
    const double aside = std::abs(below - 0.5);
    ++count_;
    sum_.crps += crps;
    sum_.rmse += miss * miss;
    sum_.inside50 += aside <= 0.25;
    sum_.inside90 += aside <= 0.45;
}

ErrorScores ErrorScoreSum::mean() const {
    return {sum_.crps / count_, std::sqrt(sum_.rmse / count_), sum_.inside50 / count_, sum_.inside90 / count_};
}

double reportLogLikelihood(double probability, bool reported) {
    constexpr double least = 1e-4;
    const double likely = std::clamp(probability, least, 1 - least);
    return logarithm(reported ? likely : 1 - likely);
}

double errorLogDensity(const ReadingDistribution& predicted, const ReadingError& error) {
    if (predicted.component[0].spread[0] < leastSpread) return std::numeric_limits<double>::quiet_NaN();
    return logarithm(std::max(predicted.density(error), 1e-300));
}

ReadingError CasePrediction::errorOf(const LoggedCase& one) const {
    return {one.measuredRange - range, wrapAngle(one.measuredBearing - bearing)};
}

CaseScore scoreOf(const LoggedCase& one, const CasePrediction& prediction) {
    const ReadingDistribution& predicted = prediction.distribution;
    CaseScore score;
    score.probability = predicted.probability();
    score.logLikelihood = reportLogLikelihood(score.probability, one.reported);
    if (!one.sound) return score;
    const ReadingError error = prediction.errorOf(one);
    for (std::size_t d = 0; d < readingDimensions; ++d) {
        const int dimension = static_cast<int>(d);
        score.error[d] = error[d];
        score.median[d] = errorQuantile(predicted, dimension, 0.5);
        score.crps[d] = rankedProbabilityScore(predicted, dimension, error[d]);
        score.below[d] = predicted.probabilityBelow(dimension, error[d]);
    }
    score.logDensity = errorLogDensity(predicted, error);
    return score;
}

SensorScores summarise(std::span<const LoggedCase> cases, std::span<const CaseScore> scores,
                       std::span<const std::size_t> chosen) {
    SensorScores sum;
    std::array<ErrorScoreSum, readingDimensions> errors;
    sum.cases = chosen.size();
    for (const std::size_t i : chosen) {
        const CaseScore& score = scores[i];
        sum.readings += cases[i].reported;
        sum.detection += score.logLikelihood;
        if (!cases[i].sound) continue;
        ++sum.sound;
        sum.logDensity += score.logDensity;
        for (std::size_t d = 0; d < readingDimensions; ++d)
            errors[d].add(score.crps[d], score.error[d] - score.median[d], score.below[d]);
    }
    for (std::size_t d = 0; d < readingDimensions; ++d) sum.error[d] = errors[d].mean();
    sum.logDensity /= static_cast<double>(sum.sound);
    sum.detection /= static_cast<double>(sum.cases);
    sum.groups = groupsOf(cases, scores, {chosen.begin(), chosen.end()});
    for (const CalibrationGroup& group : sum.groups)
        sum.off = std::max(sum.off, std::abs(group.predicted - group.reported));
    return sum;
}

std::vector<std::size_t> belowHistogram(std::span<const LoggedCase> cases, std::span<const CaseScore> scores,
                                        std::size_t dimension, std::size_t parts) {
    std::vector<std::size_t> counts(parts);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        if (!cases[i].sound) continue;
        const auto part = static_cast<std::size_t>(scores[i].below[dimension] * static_cast<double>(parts));
        ++counts[std::min(part, parts - 1)];
    }
    return counts;
}

}  // namespace mrose
