#include "learning/mlp_inference.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "learning/elementary.h"
#include "learning/reference_network.h"

namespace mrose {
namespace {

const MlpShape kShapes[] = {{4, 24, 5},   {1, 1, 1},    {2, 3, 9},    {7, 17, 2},    {3, 33, 8},
                            {40, 100, 7}, {11, 64, 16}, {5, 130, 17}, {60, 300, 33}, {4, 2, 3}};

std::string text(const MlpShape& shape) {
    return std::to_string(shape.inputs) + "-" + std::to_string(shape.hidden) + "-" + std::to_string(shape.outputs);
}

bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

TEST(MlpInference, AgreesWithTheFormulaInDouble) {
    for (const MlpShape& shape : kShapes) {
        const Mlp net = test::normalNetwork(shape, 3);
        const std::vector<float> x = test::normalNumbers(shape.inputs, 4);
        const std::vector<double> wide = test::toDouble(x);
        const std::vector<double> expected = test::referenceOutputs(shape, test::toDouble(net.parameters), wide.data());
        std::vector<float> y(shape.outputs);
        MlpInference(net).one(x.data(), y.data());
        for (int k = 0; k < shape.outputs; ++k) EXPECT_NEAR(y[k], expected[k], 2e-5) << text(shape);
    }
}

TEST(MlpInference, GivesTheSameBitsAloneInAnyBatchAndOnEveryInstructionSet) {
    constexpr std::size_t kMost = 67;
    for (const MlpShape& shape : kShapes) {
        const Mlp net = test::normalNetwork(shape, 5);
        const std::vector<float> rows = test::normalNumbers(kMost * shape.inputs, 6, 2);
        const MlpInference baseline(net, InstructionSet::baseline);
        std::vector<float> expected(kMost * shape.outputs);
        for (std::size_t row = 0; row < kMost; ++row)
            baseline.one(&rows[row * shape.inputs], &expected[row * shape.outputs]);
        for (const InstructionSet set : availableInstructionSets()) {
            const MlpInference inference(net, set);
            std::vector<float> alone(expected.size());
            for (std::size_t row = 0; row < kMost; ++row)
                inference.one(&rows[row * shape.inputs], &alone[row * shape.outputs]);
            EXPECT_TRUE(sameBits(alone, expected)) << text(shape) << " alone, " << name(set);
            for (const std::size_t n : {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 33, 64, 67}) {
                std::vector<float> out(n * shape.outputs + 1, -7.0f);
                inference.batch(rows.data(), out.data(), n);
                EXPECT_EQ(out.back(), -7.0f) << "written past the end";
                out.pop_back();
                EXPECT_TRUE(sameBits(out, {expected.begin(), expected.begin() + n * shape.outputs}))
                    << text(shape) << " batch of " << n << ", " << name(set);
            }
        }
    }
}

TEST(MlpInference, GivesTheSameBitsAtAnyPlaceOfABatch) {
    const MlpShape shape{4, 24, 5};
    const Mlp net = test::normalNetwork(shape, 7);
    const std::vector<float> row = test::normalNumbers(4, 8);
    std::vector<float> alone(5);
    MlpInference(net).one(row.data(), alone.data());
    for (std::size_t place = 0; place < 40; ++place) {
        std::vector<float> rows = test::normalNumbers(40 * 4, 9 + static_cast<unsigned>(place)), out(40 * 5);
        std::copy(row.begin(), row.end(), rows.begin() + place * 4);
        MlpInference(net).batch(rows.data(), out.data(), 40);
        EXPECT_TRUE(sameBits({out.begin() + place * 5, out.begin() + place * 5 + 5}, alone)) << place;
    }
}

TEST(MlpInference, CarriesANonFiniteInputToTheOutputs) {
    const Mlp net = test::normalNetwork({4, 24, 5}, 7);
    const float x[4] = {1, std::numeric_limits<float>::quiet_NaN(), 0, 0};
    for (const InstructionSet set : availableInstructionSets()) {
        float y[5];
        MlpInference(net, set).one(x, y);
        for (const float value : y) EXPECT_TRUE(std::isnan(value)) << name(set);
    }
}

TEST(AlignedFloats, BeginWithACacheLine) {
    for (const std::size_t count : {1, 5, 16, 1000, 100'000}) {
        const AlignedFloats floats(count);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(floats.data()) % 64, 0u) << count;
    }
}

TEST(RationalTanh, IsCloseToTheLibrarysOverTheWholeRange) {
    double worst = 0;
    for (float x = 1e-30f; x < 20; x = x < 1e-3f ? x * 1.01f : x + 1e-4f)
        worst = std::max(worst, std::abs(rationalTanh(x) - std::tanh(static_cast<double>(x))));
    EXPECT_LT(worst, 3.5e-7);
}

TEST(RationalTanh, IsRelativelyCloseNearZero) {
    for (float x = 1e-30f; x < 0.1f; x *= 1.01f)
        ASSERT_NEAR(rationalTanh(x) / std::tanh(static_cast<double>(x)), 1, 4e-7) << x;
}

TEST(RationalTanh, IsExactAtZeroAndSaturatesAtOne) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(rationalTanh(0.0f), 0.0f);
    EXPECT_TRUE(std::signbit(rationalTanh(-0.0f)));
    for (const float x : {8.992f, 20.0f, 1e10f, 3e38f, kInfinity}) {
        EXPECT_EQ(rationalTanh(x), 1.0f) << x;
        EXPECT_EQ(rationalTanh(-x), -1.0f) << x;
    }
    EXPECT_TRUE(std::isnan(rationalTanh(std::numeric_limits<float>::quiet_NaN())));
    for (float x = 7; x < 9.5f; x += 1e-3f) ASSERT_LE(rationalTanh(x), 1.0f);
}

TEST(RationalTanh, IsOdd) {
    for (float x = 1e-42f; x < 20; x *= 1.003f) ASSERT_EQ(rationalTanh(-x), -rationalTanh(x)) << x;
}

TEST(RationalTanh, KeepsTheSmallestNumbers) {
    const float x = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ(rationalTanh(x), x);
}

}  // namespace
}  // namespace mrose
