#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "learning/mlp.h"
#include "learning/pattern_matrix.h"

namespace mrose::test {

/// The network in double, straight from its formula: what the kernels are compared with.
inline std::vector<double> referenceOutputs(const MlpShape& shape, const std::vector<double>& p, const double* x) {
    const std::size_t biases = static_cast<std::size_t>(shape.hidden) * shape.inputs;
    const std::size_t weights = biases + shape.hidden;
    std::vector<double> y(p.end() - shape.outputs, p.end());
    for (int j = 0; j < shape.hidden; ++j) {
        double sum = p[biases + j];
        for (int i = 0; i < shape.inputs; ++i) sum += p[j * shape.inputs + i] * x[i];
        for (int k = 0; k < shape.outputs; ++k) y[k] += p[weights + k * shape.hidden + j] * std::tanh(sum);
    }
    return y;
}

/// df/dp by central differences.
inline std::vector<double> centralDifferences(const std::function<double(const std::vector<double>&)>& f,
                                              std::vector<double> p, double step = 1e-5) {
    std::vector<double> gradient;
    for (double& value : p) {
        const double at = value;
        value = at + step;
        const double above = f(p);
        value = at - step;
        gradient.push_back((above - f(p)) / (2 * step));
        value = at;
    }
    return gradient;
}

/// Normal numbers, the same on every run (their values do not matter to the tests).
inline std::vector<float> normalNumbers(std::size_t count, unsigned seed, float deviation = 1) {
    std::mt19937 generator(seed);
    std::normal_distribution<float> normal(0, deviation);
    std::vector<float> numbers(count);
    for (float& number : numbers) number = normal(generator);
    return numbers;
}

inline Mlp normalNetwork(MlpShape shape, unsigned seed, float deviation = 0.5f) {
    return {shape, normalNumbers(shape.parameterCount(), seed, deviation)};
}

inline PatternMatrix normalPatterns(std::size_t patterns, int features, unsigned seed) {
    return PatternMatrix::fromRows(normalNumbers(patterns * features, seed), features);
}

inline std::vector<double> toDouble(const std::vector<float>& values) { return {values.begin(), values.end()}; }

}  // namespace mrose::test
