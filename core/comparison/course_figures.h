#pragma once

#include <string>

#include "comparison/compare.h"
#include "scene/environment.h"

namespace mrose {

enum class ErrorKind { position, heading };

/// Error against time, a line for each robot: the median of its courses at each instant at which some are known, which
/// is the error itself where it has but one. cm or degrees.
std::string errorLinesFigure(const Comparison& comparison, ErrorKind kind);
std::string errorLinesLegend(const Comparison& comparison);

/// All robots that are in the world of one course, in their environment, really and simulated.
std::string courseFigure(const Comparison& comparison, std::size_t request, const Environment& environment);

/// One robot in one course, real and simulated.
std::string robotFigure(const Comparison& comparison, const ComparedCourse& course);
std::string robotFigureLegend(const Comparison& comparison);

}  // namespace mrose
