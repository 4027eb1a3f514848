#include "identification/velocity_outputs.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "geometry/elementary.h"

namespace mrose {
namespace {

using Matrix = Eigen::MatrixXd;

/// Hidden activations of some samples, one a row, with a last column of ones.
Matrix hiddenUnits(const MotionSamples& samples, const MotionNetwork& network, std::size_t first, std::size_t count) {
    using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const auto [inputs, hidden, outputs] = network.mlp.shape;
    const Eigen::Map<const RowMajor> weights(network.mlp.parameters.data(), hidden, inputs);
    const Eigen::Map<const Eigen::VectorXf> biases(network.mlp.parameters.data() + hidden * inputs, hidden);
    Matrix x(count, inputs);
    for (std::size_t r = 0; r < count; ++r) {
        const auto raw = samples.inputsOf(first + r);
        for (int i = 0; i < inputs; ++i)
            x(Eigen::Index(r), i) =
                (raw[std::size_t(i)] - network.inputs[std::size_t(i)].mean) / network.inputs[std::size_t(i)].scale;
    }
    Matrix h = Matrix::Ones(Eigen::Index(count), hidden + 1);
    h.leftCols(hidden) = ((x * weights.transpose().cast<double>()).rowwise() + biases.transpose().cast<double>())
                             .unaryExpr([](double sum) { return hyperbolicTangent(sum); });
    return h;
}

Eigen::RowVector4d velocities(const MotionSample& s) { return {s.before.v, s.before.w, s.after.v, s.after.w}; }

}  // namespace

void addVelocityOutputs(const MotionSamples& samples, MotionNetwork& network) {
    constexpr std::size_t chunk = 4096;
    const int hidden = network.mlp.shape.hidden;
    Matrix gram = Matrix::Zero(hidden + 1, hidden + 1), moments = Matrix::Zero(hidden + 1, 4);
    for (std::size_t first = 0; first < samples.samples.size(); first += chunk) {
        const std::size_t count = std::min(chunk, samples.samples.size() - first);
        const Matrix h = hiddenUnits(samples, network, first, count);
        Matrix y(Eigen::Index(count), 4);
        for (std::size_t r = 0; r < count; ++r) y.row(Eigen::Index(r)) = velocities(samples.samples[first + r]);
        gram.noalias() += h.transpose() * h;
        moments.noalias() += h.transpose() * y;
    }
    // Hidden units of several members resemble each other: a little ridge keeps their weights small.
    gram.diagonal().array() += 1e-4 * static_cast<double>(samples.samples.size());
    const Matrix weights = gram.ldlt().solve(moments);

    std::vector<float>& p = network.mlp.parameters;
    const std::vector<float> biases(p.end() - 3, p.end());
    p.resize(p.size() - 3);
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < hidden; ++j) p.push_back(static_cast<float>(weights(j, k)));
    p.insert(p.end(), biases.begin(), biases.end());
    for (int k = 0; k < 4; ++k) p.push_back(static_cast<float>(weights(hidden, k)));
    network.outputs.resize(7);
    network.mlp.shape.outputs = 7;
}

}  // namespace mrose
