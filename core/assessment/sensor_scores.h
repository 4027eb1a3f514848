#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "assessment/logged_cases.h"
#include "perception/reading_distribution.h"

namespace mrose {

/// What a model says of a case: the distribution of the reading's error, about what it expects to be true.
struct CasePrediction {
    double range = 0, bearing = 0;  ///< m, rad: true when, by the model, it was measured
    ReadingDistribution distribution;

    /// What was reported less what was true.
    ReadingError errorOf(const LoggedCase& one) const;
};

/// Dimensions of a reading: range in m, bearing in rad.
constexpr std::size_t readingDimensions = 2;

/// How good a prediction of one case was. All but the first two only of sound readings.
struct CaseScore {
    double probability = 0;    ///< of a report
    double logLikelihood = 0;  ///< of whether there was one; probabilities count as 0.0001 at least
    std::array<double, readingDimensions> error{}, median{};  ///< that there was, and predicted
    std::array<double, readingDimensions> crps{};             ///< rankedProbabilityScore()
    std::array<double, readingDimensions> below{};            ///< the probability of less than the error that there was
    double logDensity = 0;                                    ///< of both errors together: 1/(m rad)
};
CaseScore scoreOf(const LoggedCase& one, const CasePrediction& prediction);

/// Of one dimension of the sound readings of several cases.
struct ErrorScores {
    double crps = 0, rmse = 0;          ///< means, m or rad; rmse: of the median
    double inside50 = 0, inside90 = 0;  ///< share of the readings in the central 50 % and 90 % of what is predicted
};

/// Adds up what readings come to.
class ErrorScoreSum {
public:
    /// `miss`: from the median; `below`: the probability of less than there was.
    void add(double crps, double miss, double below);
    ErrorScores mean() const;

private:
    double count_ = 0;
    ErrorScores sum_;
};

/// Of whether there was a report that was this likely: 0.0001 and its complement at least.
double reportLogLikelihood(double probability, bool reported);
/// Of an error; not a number of a distribution without spread.
double errorLogDensity(const ReadingDistribution& predicted, const ReadingError& error);

/// Cases by how likely a report was predicted: what was predicted on average, and what there was.
struct CalibrationGroup {
    std::size_t cases = 0;
    double predicted = 0, reported = 0;  ///< shares
};

/// Means over cases. What there are no sound readings for is not a number.
struct SensorScores {
    std::size_t cases = 0, readings = 0, sound = 0;
    std::array<ErrorScores, readingDimensions> error;
    double logDensity = 0;  ///< not a number of what knows no spread
    double detection = 0;   ///< mean log-likelihood
    double off = 0;         ///< the largest difference between predicted and reported share of a group
    std::vector<CalibrationGroup> groups;
};

constexpr std::size_t calibrationGroups = 10;

/// `cases` and `scores` are parallel; `chosen` are indices into both. Groups are equally large and in ascending order
/// of probability, as many as there are cases for.
SensorScores summarise(std::span<const LoggedCase> cases, std::span<const CaseScore> scores,
                       std::span<const std::size_t> chosen);

/// How many sound readings had so much probability below them, in equal parts from 0 to 1: even where a model is
/// calibrated.
std::vector<std::size_t> belowHistogram(std::span<const LoggedCase> cases, std::span<const CaseScore> scores,
                                        std::size_t dimension, std::size_t parts);

}  // namespace mrose
