#pragma once

#include <string>
#include <vector>

#include "assessment/evaluate.h"
#include "diagnosis/compared_divergences.h"
#include "scene/environment.h"

namespace mrose {

// Where robots drove, really and as predicted, on equal axes with heading arrows.

/// Models whose paths are drawn: the first, and of the others the best by P.
std::vector<std::size_t> drawnModels(const Evaluation& evaluation);

/// Real and predicted path of one window, with the first prediction's error at the end.
std::string pathFigure(const Evaluation& evaluation, std::size_t window);
std::string pathLegend(const Evaluation& evaluation);

/// One robot in one rollout (an index into Comparison::rollouts), real and simulated, and where it leaves.
std::string pathFigure(const Comparison& comparison, std::size_t rollout,
                       const ComparedDivergences* divergences = nullptr);
std::string pathLegend(const Comparison& comparison, const ComparedDivergences* divergences = nullptr);

/// All robots that are in the world of one rollout, in their environment, and where they leave the real trajectory: a
/// picture that needs no legend beside it.
std::string rolloutFigure(const Comparison& comparison, std::size_t request, const Environment& environment,
                          const ComparedDivergences* divergences = nullptr);

}  // namespace mrose
