#pragma once

#include <string>

#include "assessment/stream_comparison.h"

namespace mrose {

// Pictures of what a sensor reported, real and simulated, as <svg> elements: real broad and orange, simulated narrow
// and blue above it.

/// The share of the subjects in view that was reported, by range or by bearing, within bands of two standard errors.
std::string reportsByRangeFigure(const ComparedSensor& sensor);
std::string reportsByBearingFigure(const ComparedSensor& sensor);

/// Histograms of the errors of what was reported, over the middle 98 % of both.
std::string rangeErrorFigure(const ComparedSensor& sensor);
std::string bearingErrorFigure(const ComparedSensor& sensor);

}  // namespace mrose
