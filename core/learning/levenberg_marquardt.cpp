#include "learning/levenberg_marquardt.h"

#include <algorithm>
#include <cassert>

#include <Eigen/Cholesky>

#include "learning/gauss_newton.h"

namespace mrose {

LevenbergMarquardt::LevenbergMarquardt(const MlpGradient& gradient, const PatternMatrix& inputs,
                                       const PatternMatrix& targets, const LevenbergMarquardtOptions& options)
    : gradient_(gradient),
      inputs_(inputs),
      targets_(targets),
      options_(options),
      slope_(gradient.shape().parameterCount()),
      damping_(options.firstDamping) {}

bool LevenbergMarquardt::step(std::span<float> parameters) {
    assert(parameters.size() == slope_.size());
    loss_ = gradient_.meanSquaredError(parameters, inputs_, targets_, slope_);
    const std::size_t every = std::min(options_.matrixEvery, inputs_.blocks());
    const std::vector<double> matrix = gaussNewtonMatrix(gradient_.shape(), parameters, inputs_,
                                                         {steps_++ % every, every}, gradient_.instructionSet());
    for (; damping_ <= options_.mostDamping; damping_ *= options_.growth) {
        if (!attempt(parameters, matrix)) continue;
        damping_ = std::max(damping_ * options_.shrinkage, options_.leastDamping);
        return true;
    }
    damping_ = options_.firstDamping;
    return false;
}

bool LevenbergMarquardt::attempt(std::span<float> parameters, const std::vector<double>& matrix) {
    const Eigen::Index count = static_cast<Eigen::Index>(parameters.size());
    Eigen::MatrixXd damped = Eigen::Map<const Eigen::MatrixXd>(matrix.data(), count, count);
    const double floor = 1e-6 * damped.trace() / static_cast<double>(count);
    for (Eigen::Index i = 0; i < count; ++i) damped(i, i) += damping_ * std::max(damped(i, i), floor);
    Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(damped);
    if (factors.info() != Eigen::Success) return false;
    const Eigen::VectorXd step = factors.solve(Eigen::Map<const Eigen::VectorXd>(slope_.data(), count));
    std::vector<float> trial(parameters.begin(), parameters.end());
    for (Eigen::Index i = 0; i < count; ++i) trial[i] = static_cast<float>(trial[i] - step(i));
    const double loss = gradient_.meanSquaredError(trial, inputs_, targets_);
    if (!(loss < loss_)) return false;
    std::copy(trial.begin(), trial.end(), parameters.begin());
    loss_ = loss;
    return true;
}

}  // namespace mrose
