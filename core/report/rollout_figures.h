#pragma once

#include <string>

#include "diagnosis/compared_divergences.h"
#include "scene/environment.h"

namespace mrose {

enum class ErrorKind { position, heading };

/// Error against time, a line for each robot: the median of its rollouts at each instant at which some are known, which
/// is the error itself where it has but one. cm or degrees.
/// With `divergences` the bound, where it is a constant, and a ring where a robot leaves a single rollout by that
/// error.
std::string errorLinesFigure(const Comparison& comparison, ErrorKind kind,
                             const ComparedDivergences* divergences = nullptr);
std::string errorLinesLegend(const Comparison& comparison, const ComparedDivergences* divergences = nullptr);

/// All robots that are in the world of one rollout, in their environment, really and simulated, and where they leave
/// the real trajectory.
std::string rolloutFigure(const Comparison& comparison, std::size_t request, const Environment& environment,
                          const ComparedDivergences* divergences = nullptr);

/// One robot in one rollout (an index into Comparison::rollouts), real and simulated.
std::string robotFigure(const Comparison& comparison, std::size_t rollout,
                        const ComparedDivergences* divergences = nullptr);
std::string robotFigureLegend(const Comparison& comparison, bool divergences = false);

}  // namespace mrose
