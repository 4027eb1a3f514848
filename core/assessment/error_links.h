#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/logged_cases.h"
#include "assessment/sensor_scores.h"
#include "perception/reading_noise.h"

namespace mrose {

/// How far two errors of one robot go together: the correlation of their normal scores, which are standard normal and
/// independent where a prediction is right and errors have nothing in common.
struct ErrorLink {
    std::size_t pairs = 0;
    double real = 0;   ///< not a number of too few pairs
    double model = 0;  ///< what the model draws; not a number of one that does not say
};

/// Of one dimension.
struct ErrorLinks {
    ErrorLink next;    ///< of one subject, at successive looks that are at most 1 s apart
    ErrorLink beside;  ///< of two subjects of one look
};
/// Of all robots, or one of LoggedCases::robots.
ErrorLinks errorLinks(const LoggedCases& cases, std::span<const CaseScore> scores, std::size_t dimension,
                      const ReadingNoises* noises, std::optional<std::size_t> robot = {});

/// Mean errors of a robot's sound readings: biases. Not a number of none.
struct MeanErrors {
    std::array<double, readingDimensions> real{}, predicted{};
};
MeanErrors meanErrors(const LoggedCases& cases, std::span<const CasePrediction> predictions,
                      std::span<const CaseScore> scores, std::size_t robot);

}  // namespace mrose
