#pragma once

#include <cstdint>
#include <vector>

#include "identification/likelihood_objective.h"
#include "learning/decision_trees.h"

namespace mrose {

struct TreeOptions {
    int trees = 10;  ///< for each output, each grown from patterns drawn with repetition
    int depth = 12;  ///< at most
    int leaf = 40;   ///< patterns of a leaf, at least
    std::uint64_t seed = 1;
};

/// Regression trees, grown by OpenCV, for the mean of targets[output][pattern].
DecisionTrees growMeanTrees(const PatternMatrix& inputs, std::span<const std::vector<double>> targets,
                            const TreeOptions& options);

/// Regression trees whose leaves say the normal quantile of the share of `reports`, in the units of
/// data.outputs[0].
DecisionTrees growReportTrees(const LikelihoodData& data, const std::vector<bool>& reports, const TreeOptions& options);

/// Trees for the mean and the logarithm of the standard deviation of errors[dimension][pattern], in the order of a
/// reading's form with one component, without its first output. Standard deviations are about the means of those trees
/// alone that have not seen the pattern.
DecisionTrees growErrorTrees(const LikelihoodData& data, const std::vector<std::vector<double>>& errors,
                             const TreeOptions& options);

}  // namespace mrose
