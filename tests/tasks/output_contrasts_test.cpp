#include "tasks/output_contrasts.h"

#include <cmath>

#include <gtest/gtest.h>

#include "learning/initial_weights.h"

namespace mrose {
namespace {

const std::vector<NetworkVariable> threeOutputs{{"a", "s", 10, 2}, {"b", "s", 12, 3}, {"c", "s", 9, 0.5}};

/// y = V tanh(W x + b) + c, in double.
std::vector<double> outputsOf(const Mlp& mlp, std::span<const double> x) {
    const auto [inputs, hidden, outputs] = mlp.shape;
    const auto at = [&](int index) { return static_cast<double>(mlp.parameters[static_cast<std::size_t>(index)]); };
    std::vector<double> y;
    const int second = hidden * (inputs + 1);
    for (int k = 0; k < outputs; ++k) {
        double sum = at(second + outputs * hidden + k);
        for (int j = 0; j < hidden; ++j) {
            double into = at(hidden * inputs + j);
            for (int i = 0; i < inputs; ++i) into += at(j * inputs + i) * x[static_cast<std::size_t>(i)];
            sum += at(second + k * hidden + j) * std::tanh(into);
        }
        y.push_back(sum);
    }
    return y;
}

TEST(OutputContrasts, AreTheMeanAndTheDifferencesFromIt) {
    const std::vector<float> rows{1, 0, 0, -1, 2, 1, 0, -2, -1};
    const OutputContrasts contrasts(rows, threeOutputs);
    ASSERT_EQ(contrasts.count(), 4u);
    const std::vector<float> learned = contrasts.of(rows);
    ASSERT_EQ(learned.size(), 12u);
    // Seconds from the outputs' means: 2 0 0; -2 6 0.5; 0 -6 -0.5. Their means: 2/3, 1.5, -13/6.
    const double mean = std::sqrt((4.0 / 9 + 2.25 + 169.0 / 36) / 3);
    EXPECT_NEAR(learned[0], 2.0 / 3 / mean, 1e-6);
    EXPECT_NEAR(learned[4], 1.5 / mean, 1e-6);
    const double a = std::sqrt((16.0 / 9 + 12.25 + 169.0 / 36) / 3);
    EXPECT_NEAR(learned[1], 4.0 / 3 / a, 1e-6);
    EXPECT_NEAR(learned[5], -3.5 / a, 1e-6);
    for (std::size_t k = 0; k < 4; ++k) {
        double squares = 0;
        for (std::size_t row = 0; row < 3; ++row) squares += std::pow(static_cast<double>(learned[4 * row + k]), 2);
        EXPECT_NEAR(squares, 3, 1e-5);
    }
}

TEST(OutputContrasts, UndoneNetworkGivesTheOutputsThemselves) {
    const std::vector<float> rows{1, 0, 0, -1, 2, 1, 0, -2, -1};
    const OutputContrasts contrasts(rows, threeOutputs);
    const Mlp network = randomMlp({2, 5, 4}, {.seed = 3});
    const Mlp undone = contrasts.undone(network);
    EXPECT_EQ(undone.shape, (MlpShape{2, 5, 3}));
    EXPECT_EQ(undone.parameters.size(), undone.shape.parameterCount());
    const std::vector<float> first = contrasts.of(std::span(rows).first(3));
    const double differences[]{2.0 / 3, 4.0 / 3, -2.0 / 3, -2.0 / 3};  // of the first row, as above
    for (const double x : {-1.0, 0.3, 2.0}) {
        const double inputs[]{x, 0.5 - x};
        const std::vector<double> learned = outputsOf(network, inputs), outputs = outputsOf(undone, inputs);
        const auto seconds = [&](std::size_t k) { return differences[k] / static_cast<double>(first[k]) * learned[k]; };
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(outputs[k] * threeOutputs[k].scale, seconds(0) + seconds(k + 1), 1e-4);
    }
}

}  // namespace
}  // namespace mrose
