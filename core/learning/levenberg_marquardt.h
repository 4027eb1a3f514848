#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "learning/mlp_gradient.h"

namespace mrose {

/// Levenberg 1944, Marquardt 1963; for one-step fitting of small networks. Loss and gradient are over all patterns, the
/// matrix of second derivatives over one block in `matrixEvery`, another one in every step.
struct LevenbergMarquardtOptions {
    double firstDamping = 1e-2, leastDamping = 1e-7, mostDamping = 1e7;
    double growth = 4, shrinkage = 0.3;  ///< of the damping after a worse and a better trial
    std::size_t matrixEvery = 8;
};

class LevenbergMarquardt {
public:
    /// Keeps references to all but the options.
    LevenbergMarquardt(const MlpGradient& gradient, const PatternMatrix& inputs, const PatternMatrix& targets,
                       const LevenbergMarquardtOptions& options = {});

    /// Moves to parameters with a smaller mean squared error; false, leaving them, if none was found at any damping.
    bool step(std::span<float> parameters);

    /// Mean squared error after the last step.
    double loss() const { return loss_; }

private:
    bool attempt(std::span<float> parameters, const std::vector<double>& matrix);

    const MlpGradient& gradient_;
    const PatternMatrix& inputs_;
    const PatternMatrix& targets_;
    LevenbergMarquardtOptions options_;
    std::vector<double> slope_;
    double damping_, loss_ = 0;
    std::size_t steps_ = 0;
};

}  // namespace mrose
