#include "learning/initial_weights.h"

#include <cmath>
#include <span>

#include <gtest/gtest.h>

#include "learning/mlp_gradient.h"
#include "learning/reference_network.h"

namespace mrose {
namespace {

TEST(InitialWeights, DependOnTheSeedAlone) {
    const MlpShape shape{4, 24, 5};
    EXPECT_EQ(randomMlp(shape, {.seed = 7}), randomMlp(shape, {.seed = 7}));
    EXPECT_NE(randomMlp(shape, {.seed = 7}), randomMlp(shape, {.seed = 8}));
}

TEST(InitialWeights, AreUniformWithinTheirScales) {
    const MlpShape shape{24, 400, 50};  // 5 = sqrt(inputs + 1), 20 = sqrt(hidden)
    const Mlp net = randomMlp(shape, {.seed = 3, .hiddenScale = 1, .outputScale = 2});
    const auto hidden = std::span(net.parameters).first(400 * 25), output = std::span(net.parameters).subspan(400 * 25);
    const auto check = [](std::span<const float> values, double scale) {
        double sum = 0, squares = 0;
        for (const float value : values) {
            EXPECT_LE(std::abs(value), scale);
            sum += value;
            squares += value * value;
        }
        const double n = static_cast<double>(values.size());
        EXPECT_NEAR(sum / n, 0, 4 * scale / std::sqrt(3 * n));
        EXPECT_NEAR(squares / n, scale * scale / 3, 4 * scale * scale * 0.3 / std::sqrt(n));
    };
    check(hidden, 1.0 / 5);
    check(output.first(400 * 50), 2.0 / 20);
    for (const float bias : output.last(50)) EXPECT_EQ(bias, 0);
}

/// Patterns whose targets are a linear map of their inputs, of variance 1.
PatternSet linearPatterns(std::size_t count) {
    PatternSet patterns{test::normalPatterns(count, 3, 11), PatternMatrix(count, 2)};
    for (std::size_t p = 0; p < count; ++p) {
        const PatternMatrix& x = patterns.inputs;
        patterns.targets(p, 0) = 0.6F * x(p, 0) - 0.8F * x(p, 1);
        patterns.targets(p, 1) = -0.28F * x(p, 1) + 0.96F * x(p, 2);
    }
    return patterns;
}

/// With z of deviation d, d^-1 tanh(d z) is d^-1 z but for d^2 z^3 / 3 + ..., whose mean square is 15 d^4 / 9 at most.
TEST(InitialWeights, LinearOnesPredictWhatIsLinear) {
    const PatternSet patterns = linearPatterns(20000);
    const MlpShape shape{3, 12, 2};
    Mlp net = randomMlp(shape, {.seed = 5, .outputScale = 0});
    const MlpGradient engine(shape);
    EXPECT_NEAR(engine.meanSquaredError(net.parameters, patterns.inputs, patterns.targets), 1, 0.03);
    startLinear(net, patterns);
    const double error = engine.meanSquaredError(net.parameters, patterns.inputs, patterns.targets);
    EXPECT_LT(error, 15 * std::pow(0.3, 4) / 9);
    EXPECT_GT(error, 0.002) << "a start at which tanh is straight: nothing could bend it";
}

TEST(InitialWeights, LinearOnesLeaveTheOtherUnitsAsTheyWere) {
    const MlpShape shape{3, 12, 2};
    const Mlp random = randomMlp(shape, {.seed = 5});
    Mlp net = random;
    startLinear(net, linearPatterns(500));
    for (int unit = 2; unit < shape.hidden; ++unit) {
        for (int i = 0; i < 3; ++i) EXPECT_EQ(net.parameters[unit * 3 + i], random.parameters[unit * 3 + i]);
        EXPECT_EQ(net.parameters[36 + unit], random.parameters[36 + unit]);
        for (int k = 0; k < 2; ++k)
            EXPECT_EQ(net.parameters[48 + k * 12 + unit], random.parameters[48 + k * 12 + unit]);
    }
    EXPECT_NE(net.parameters[0], random.parameters[0]);
}

TEST(InitialWeights, LinearOnesNeedUnitsToSpareAndPatterns) {
    const Mlp small = randomMlp({3, 4, 2}), large = randomMlp({3, 5, 2});
    Mlp net = small;
    startLinear(net, linearPatterns(500));
    EXPECT_EQ(net, small);
    net = large;
    startLinear(net, {});
    EXPECT_EQ(net, large);
    startLinear(net, linearPatterns(500));
    EXPECT_NE(net, large);
}

}  // namespace
}  // namespace mrose
