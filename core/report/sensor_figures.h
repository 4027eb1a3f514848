#pragma once

#include <string>

#include "assessment/sensor_assessment.h"

namespace mrose {

// How well the readings of a sensor are predicted, as plots. Ranges are in cm, bearings in mrad.

/// What a dimension of a reading is called on a page, and its unit there.
struct ShownDimension {
    const char* name;
    const char* unit;
    double factor;  ///< of the unit
};
const ShownDimension& shownDimension(std::size_t dimension);

/// Error against range or bearing: which part of the real readings, and of what the first model predicts, lies below.
std::string errorBandFigure(const SensorEvaluation& evaluation, std::size_t dimension, BandAxis axis);
std::string errorBandLegend(const SensorEvaluation& evaluation);

/// The share that was reported against the one that was predicted, by groups of equally many cases.
std::string reliabilityFigure(const SensorEvaluation& evaluation);
/// The share of the real readings in the central part of what is predicted, against how large that part is.
std::string coverageFigure(const SensorEvaluation& evaluation, std::size_t dimension);
/// How many of the real readings fall into each twentieth of what the first model predicts.
std::string belowFigure(const SensorEvaluation& evaluation, std::size_t dimension);
std::string sensorLegend(const SensorEvaluation& evaluation);

}  // namespace mrose
