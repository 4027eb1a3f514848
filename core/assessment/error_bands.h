#pragma once

#include <array>
#include <span>
#include <vector>

#include "assessment/sensor_scores.h"

namespace mrose {

/// Of which parts of the readings the errors are below what a band shows.
constexpr std::array<double, 5> bandShares{0.05, 0.25, 0.5, 0.75, 0.95};

/// The errors of the sound readings of subjects within a part of the field of view.
struct ErrorBand {
    double from = 0, to = 0;  ///< m of range, or rad of bearing
    std::size_t readings = 0;
    std::array<double, bandShares.size()> real{}, predicted{};  ///< m or rad
};

enum class BandAxis { range, bearing };

/// Against range by 0.5 m or bearing by 5 degrees, of parts with 20 readings or more. What is predicted is the mean of
/// the readings' distributions, not of draws.
std::vector<ErrorBand> errorBands(std::span<const LoggedCase> cases, std::span<const CasePrediction> predictions,
                                  std::size_t dimension, BandAxis axis);

}  // namespace mrose
