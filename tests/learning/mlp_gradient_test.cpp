#include "learning/mlp_gradient.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "learning/reference_network.h"

namespace mrose {
namespace {

struct Case {
    MlpShape shape;
    std::size_t patterns;
};

const Case kCases[] = {{{4, 24, 5}, 300}, {{1, 1, 1}, 1},   {{3, 5, 2}, 17},   {{6, 7, 9}, 256},
                       {{2, 13, 4}, 513}, {{9, 41, 7}, 70}, {{12, 70, 3}, 140}};

std::string text(const Case& c, InstructionSet set) {
    return std::to_string(c.shape.inputs) + "-" + std::to_string(c.shape.hidden) + "-" +
           std::to_string(c.shape.outputs) + ", " + std::to_string(c.patterns) + " patterns, " + name(set);
}

double referenceMse(const MlpShape& shape, const std::vector<double>& parameters, const PatternMatrix& inputs,
                    const PatternMatrix& targets) {
    const std::vector<double> rows = test::toDouble(inputs.toRows());
    double sum = 0;
    for (std::size_t n = 0; n < inputs.patterns(); ++n) {
        const auto y = test::referenceOutputs(shape, parameters, &rows[n * shape.inputs]);
        for (int k = 0; k < shape.outputs; ++k) sum += std::pow(y[k] - targets(n, k), 2);
    }
    return sum / (static_cast<double>(inputs.patterns()) * shape.outputs);
}

void expectClose(const std::vector<double>& actual, const std::vector<double>& expected, const std::string& what) {
    double scale = 0;
    for (const double value : expected) scale = std::max(scale, std::abs(value));
    for (std::size_t i = 0; i < expected.size(); ++i)
        ASSERT_NEAR(actual[i], expected[i], 2e-5 * scale + 1e-7) << what << ", parameter " << i;
}

TEST(MlpGradient, OfTheMeanSquaredErrorEqualsCentralDifferences) {
    for (const Case& c : kCases) {
        const Mlp net = test::normalNetwork(c.shape, 1);
        const PatternMatrix x = test::normalPatterns(c.patterns, c.shape.inputs, 2);
        const PatternMatrix t = test::normalPatterns(c.patterns, c.shape.outputs, 3);
        const auto mse = [&](const std::vector<double>& p) { return referenceMse(c.shape, p, x, t); };
        const std::vector<double> at = test::toDouble(net.parameters);
        const std::vector<double> expected = test::centralDifferences(mse, at);
        for (const InstructionSet set : availableInstructionSets()) {
            std::vector<double> gradient(net.parameters.size(), 99);
            const MlpGradient engine(c.shape, set);
            const double loss = engine.meanSquaredError(net.parameters, x, t, gradient);
            EXPECT_NEAR(loss, mse(at), 1e-5 * loss) << text(c, set);
            EXPECT_EQ(loss, engine.meanSquaredError(net.parameters, x, t)) << text(c, set);
            expectClose(gradient, expected, text(c, set));
        }
    }
}

/// A loss that couples consecutive patterns: the squares of sums over three of them, of every output.
double windowLoss(const PatternMatrix& y) {
    double loss = 0;
    for (std::size_t n = 0; n + 3 <= y.patterns(); ++n)
        for (int k = 0; k < y.features(); ++k) loss += std::pow(double{y(n, k)} + y(n + 1, k) + y(n + 2, k), 2);
    return loss;
}

PatternMatrix windowLossGradient(const PatternMatrix& y) {
    PatternMatrix gradient(y.patterns(), y.features());
    for (std::size_t n = 0; n + 3 <= y.patterns(); ++n)
        for (int k = 0; k < y.features(); ++k)
            for (std::size_t m = n; m < n + 3; ++m) gradient(m, k) += 2 * (y(n, k) + y(n + 1, k) + y(n + 2, k));
    return gradient;
}

double referenceWindowLoss(const MlpShape& shape, const std::vector<double>& p, const std::vector<double>& rows) {
    std::vector<std::vector<double>> y;
    for (std::size_t n = 0; n < rows.size() / shape.inputs; ++n)
        y.push_back(test::referenceOutputs(shape, p, &rows[n * shape.inputs]));
    double loss = 0;
    for (std::size_t n = 0; n + 3 <= y.size(); ++n)
        for (int k = 0; k < shape.outputs; ++k) loss += std::pow(y[n][k] + y[n + 1][k] + y[n + 2][k], 2);
    return loss;
}

TEST(MlpGradient, OfACallersLossEqualsCentralDifferencesInParametersAndInputs) {
    for (const Case& c : kCases) {
        const Mlp net = test::normalNetwork(c.shape, 4);
        const PatternMatrix x = test::normalPatterns(c.patterns, c.shape.inputs, 5);
        const std::vector<double> rows = test::toDouble(x.toRows()), at = test::toDouble(net.parameters);
        const auto expected =
            test::centralDifferences([&](const auto& p) { return referenceWindowLoss(c.shape, p, rows); }, at);
        const auto expectedInputs =
            c.patterns > 200
                ? std::vector<double>{}
                : test::centralDifferences([&](const auto& r) { return referenceWindowLoss(c.shape, at, r); }, rows);
        for (const InstructionSet set : availableInstructionSets()) {
            const MlpGradient engine(c.shape, set);
            PatternMatrix y, hidden, dx;
            engine.forward(net.parameters, x, y, &hidden);
            EXPECT_NEAR(windowLoss(y), referenceWindowLoss(c.shape, at, rows), 1e-4 * windowLoss(y)) << text(c, set);
            const PatternMatrix dy = windowLossGradient(y);
            std::vector<double> kept(at.size(), 0.0), recomputed(at.size(), 0.0);
            engine.backward(net.parameters, x, dy, kept, &hidden, &dx);
            engine.backward(net.parameters, x, dy, recomputed);
            EXPECT_EQ(kept, recomputed) << text(c, set);
            expectClose(kept, expected, text(c, set));
            if (expectedInputs.empty()) continue;
            expectClose(test::toDouble(dx.toRows()), expectedInputs, text(c, set) + ", inputs");
        }
    }
}

TEST(MlpGradient, IsAddedToByBackward) {
    const MlpShape shape{3, 8, 2};
    const Mlp net = test::normalNetwork(shape, 1);
    const PatternMatrix x = test::normalPatterns(50, 3, 2), dy = test::normalPatterns(50, 2, 3);
    std::vector<double> once(net.parameters.size()), twice(net.parameters.size());
    const MlpGradient engine(shape);
    engine.backward(net.parameters, x, dy, once);
    engine.backward(net.parameters, x, dy, twice);
    engine.backward(net.parameters, x, dy, twice);
    for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(twice[i], 2 * once[i]);
}

TEST(MlpGradient, IgnoresWhatLiesInThePaddingOfABlock) {
    const MlpShape shape{3, 8, 2};
    const Mlp net = test::normalNetwork(shape, 1);
    PatternMatrix x = test::normalPatterns(21, 3, 2), dy = test::normalPatterns(21, 2, 3);
    const MlpGradient engine(shape);
    std::vector<double> clean(net.parameters.size()), dirty(net.parameters.size());
    engine.backward(net.parameters, x, dy, clean);
    for (std::size_t p = 21; p < PatternMatrix::kBlock; ++p) x.block(0)[p] = dy.block(0)[p] = 5;
    engine.backward(net.parameters, x, dy, dirty);
    EXPECT_EQ(clean, dirty);
}

TEST(MlpGradient, ThroughTwoStepsOfTimeEqualsCentralDifferences) {
    const MlpShape shape{3, 6, 2};  // outputs become the first two inputs of the next step
    const Mlp net = test::normalNetwork(shape, 8);
    const PatternMatrix start = test::normalPatterns(20, 3, 9);
    const std::vector<double> rows = test::toDouble(start.toRows());
    const auto loss = [&](const std::vector<double>& p) {
        double sum = 0;
        for (std::size_t n = 0; n < 20; ++n) {
            auto y = test::referenceOutputs(shape, p, &rows[n * 3]);
            const double x[3] = {y[0], y[1], rows[n * 3 + 2]};
            y = test::referenceOutputs(shape, p, x);
            sum += y[0] * y[0] / 2 + y[1] * y[1] / 2;
        }
        return sum;
    };
    const MlpGradient engine(shape);
    PatternMatrix y, h0, h1, dx, x1 = start;
    engine.forward(net.parameters, start, y, &h0);
    for (std::size_t n = 0; n < 20; ++n)
        for (int k = 0; k < 2; ++k) x1(n, k) = y(n, k);
    engine.forward(net.parameters, x1, y, &h1);
    std::vector<double> gradient(net.parameters.size());
    engine.backward(net.parameters, x1, y, gradient, &h1, &dx);
    PatternMatrix dy(20, 2);
    for (std::size_t n = 0; n < 20; ++n)
        for (int k = 0; k < 2; ++k) dy(n, k) = dx(n, k);
    engine.backward(net.parameters, start, dy, gradient, &h0);
    expectClose(gradient, test::centralDifferences(loss, test::toDouble(net.parameters)), "two steps");
}

TEST(MlpGradient, DoesNotDependOnTheNumberOfThreads) {
    const MlpShape shape{4, 24, 5};
    const Mlp net = test::normalNetwork(shape, 1);
    const PatternMatrix x = test::normalPatterns(30011, 4, 2), t = test::normalPatterns(30011, 5, 3);
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 8);
    const auto run = [&](int threads) {
        tbb::task_arena arena(threads);
        return arena.execute([&] {
            std::vector<double> results(net.parameters.size());
            const MlpGradient engine(shape);
            const double loss = engine.meanSquaredError(net.parameters, x, t, results);
            PatternMatrix y, dx;
            engine.forward(net.parameters, x, y);
            std::vector<double> other(net.parameters.size());
            engine.backward(net.parameters, x, y, other, nullptr, &dx);
            results.push_back(loss);
            results.insert(results.end(), other.begin(), other.end());
            for (const float value : dx.toRows()) results.push_back(value);
            return results;
        });
    };
    const std::vector<double> one = run(1);
    EXPECT_EQ(one, run(2));
    EXPECT_EQ(one, run(8));
}

TEST(MlpGradient, GivesTheSameBitsOnEveryInstructionSet) {
    for (const Case& c : kCases) {
        const Mlp net = test::normalNetwork(c.shape, 1);
        const PatternMatrix x = test::normalPatterns(c.patterns, c.shape.inputs, 2);
        const PatternMatrix t = test::normalPatterns(c.patterns, c.shape.outputs, 3);
        const auto resultsOf = [&](InstructionSet set) {
            std::vector<double> results(net.parameters.size());
            const MlpGradient engine(c.shape, set);
            const double loss = engine.meanSquaredError(net.parameters, x, t, results);
            PatternMatrix y, hidden, dx;
            engine.forward(net.parameters, x, y, &hidden);
            std::vector<double> other(net.parameters.size());
            engine.backward(net.parameters, x, y, other, &hidden, &dx);
            results.push_back(loss);
            results.insert(results.end(), other.begin(), other.end());
            for (const PatternMatrix* const matrix : {&y, &hidden, &dx})
                for (const float value : matrix->toRows()) results.push_back(value);
            return results;
        };
        const std::vector<double> baseline = resultsOf(InstructionSet::baseline);
        for (const InstructionSet set : availableInstructionSets())
            EXPECT_TRUE(resultsOf(set) == baseline) << text(c, set);
    }
}

TEST(WeightDecay, TakesWeightsAndLeavesBiases) {
    const MlpShape shape{2, 1, 1};  // parameters: w, w, b, v, c
    std::vector<double> gradient(5, 1.0);
    const std::vector<float> parameters = {1, -2, 4, 3, 8};
    EXPECT_DOUBLE_EQ(addWeightDecay(shape, parameters, 0.5, gradient), 0.5 * (1 + 4 + 9));
    EXPECT_EQ(gradient, (std::vector<double>{2, -1, 1, 4, 1}));
}

TEST(PatternMatrix, ComesBackAsTheSameRows) {
    for (const std::size_t patterns : {0, 1, 255, 256, 257, 1000}) {
        const std::vector<float> rows = test::normalNumbers(patterns * 3, 1);
        EXPECT_EQ(PatternMatrix::fromRows(rows, 3).toRows(), rows) << patterns;
    }
}

}  // namespace
}  // namespace mrose
