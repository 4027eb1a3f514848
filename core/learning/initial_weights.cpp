#include "learning/initial_weights.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Random123/philox.h>

namespace mrose {

namespace {

/// Uniform in the open interval (-1, 1).
double uniform(std::uint64_t seed, std::uint64_t index) {
    const r123::Philox2x64::ctr_type counter = {{index, 0}};
    const r123::Philox2x64::key_type key = {{seed}};
    const std::uint64_t bits = r123::Philox2x64()(counter, key)[0];
    return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-52 - 1.0;
}

}  // namespace

Mlp randomMlp(MlpShape shape, const InitialWeights& options) {
    Mlp net{shape, std::vector<float>(shape.parameterCount())};
    const double hidden = options.hiddenScale / std::sqrt(shape.inputs + 1.0);
    const double output = options.outputScale / std::sqrt(static_cast<double>(shape.hidden));
    const std::size_t firstOutput = static_cast<std::size_t>(shape.hidden) * (shape.inputs + 1);
    for (std::size_t i = 0; i + shape.outputs < net.parameters.size(); ++i)
        net.parameters[i] = static_cast<float>((i < firstOutput ? hidden : output) * uniform(options.seed, i));
    return net;
}

void startLinear(Mlp& net, const PatternSet& patterns) {
    constexpr double deviation = 0.3;  // of what goes into tanh, which takes 3 % off so much
    constexpr double ridge = 1e-3;     // of a standardised input's square: neighbouring inputs are much alike
    const Eigen::Index inputs = net.shape.inputs, outputs = net.shape.outputs, hidden = net.shape.hidden;
    if (2 * outputs >= hidden || patterns.inputs.patterns() == 0) return;
    Eigen::MatrixXd squares = ridge * Eigen::MatrixXd::Identity(inputs, inputs);
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(inputs, outputs);
    Eigen::VectorXd x(inputs), y(outputs);
    const double share = 1 / static_cast<double>(patterns.inputs.patterns());
    for (std::size_t p = 0; p < patterns.inputs.patterns(); ++p) {
        for (Eigen::Index i = 0; i < inputs; ++i) x(i) = patterns.inputs(p, static_cast<int>(i));
        for (Eigen::Index k = 0; k < outputs; ++k) y(k) = patterns.targets(p, static_cast<int>(k));
        squares += share * x * x.transpose();
        products += share * x * y.transpose();
    }
    const Eigen::MatrixXd map = squares.llt().solve(products);  // inputs x outputs
    float* const weights = net.parameters.data();
    float* const biases = weights + hidden * inputs;
    float* const outgoing = biases + hidden;
    for (Eigen::Index k = 0; k < outputs; ++k) {
        const double gain = deviation / std::max(1e-6, std::sqrt(map.col(k).dot(squares * map.col(k))));
        for (Eigen::Index i = 0; i < inputs; ++i) weights[k * inputs + i] = static_cast<float>(gain * map(i, k));
        biases[k] = 0;
        for (Eigen::Index o = 0; o < outputs; ++o)
            outgoing[o * hidden + k] = o == k ? static_cast<float>(1 / gain) : 0.0F;
    }
}

}  // namespace mrose
