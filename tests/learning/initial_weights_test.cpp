#include "learning/initial_weights.h"

#include <cmath>
#include <span>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace mrose
