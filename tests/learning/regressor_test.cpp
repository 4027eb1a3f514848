// Lookup tables and decision trees, and what networks, tables and trees have in common.
#include "learning/regressor.h"

#include <array>
#include <cmath>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/toml_table.h"
#include "learning/network_file.h"
#include "learning/reference_network.h"
#include "learning/table_gradient.h"
#include "world/noise.h"

namespace mrose {
namespace {

using testing::FloatNear;
using testing::HasSubstr;

double uniform(int i, int channel = 0) { return 2 * uniformNoise({11, i, 0, static_cast<std::uint32_t>(channel)}) - 1; }

/// A grid over inputs 2 and 0 whose values are f of its points, and one over input 1.
template <class F, class G>
LookupTable tableOf(const F& f, const G& g) {
    LookupTable table{3, 2, {}};
    const std::vector<float> a{-1, 0.5, 2}, b{-2, 0, 1, 3}, c{-1, 1};
    LookupTable::Grid plane{{{2, a}, {0, b}}, {}}, line{{{1, c}}, {}};
    for (const float x2 : a)
        for (const float x0 : b)
            for (int k = 0; k < 2; ++k) plane.values.push_back(static_cast<float>(f(x2, x0, k)));
    for (const float x1 : c)
        for (int k = 0; k < 2; ++k) line.values.push_back(static_cast<float>(g(x1, k)));
    table.grids = {plane, line};
    return table;
}

LookupTable someTable() {
    return tableOf([](float x2, float x0, int k) { return std::sin(x2 + 2 * x0 + k); },
                   [](float x1, int k) { return x1 * (k + 0.5f); });
}

DecisionTrees someTrees() {
    // x1 <= 0.25 ? (x0 <= -1 ? 3 : 5) : 7, and a constant tree for the same output
    return {2, 2, {{0, {{1, 0.25f, 1, 2}, {0, -1, 3, 4}, {-1, 7}, {-1, 3}, {-1, 5}}}, {0, {{-1, 1}}}}};
}

TEST(LookupTables, AreMultilinearBetweenTheirPoints) {
    // bilinear in the plane's inputs, so that interpolation is exact
    const auto plane = [](double x2, double x0, int k) { return 1 + 2 * x2 - x0 + 0.5 * x2 * x0 + k; };
    const auto line = [](double x1, int k) { return (k + 1) * x1; };
    const LookupTable table = tableOf(plane, line);
    for (int i = 0; i < 200; ++i) {
        const std::array<float, 3> x{static_cast<float>(0.5 + 2.5 * uniform(i, 1)), static_cast<float>(uniform(i, 2)),
                                     static_cast<float>(0.5 + 1.5 * uniform(i, 3))};
        std::array<float, 2> y;
        table.evaluate(x.data(), y.data());
        for (int k = 0; k < 2; ++k) EXPECT_NEAR(y[k], plane(x[2], x[0], k) + line(x[1], k), 1e-5);
    }
}

TEST(LookupTables, AreConstantBeyondTheirEnds) {
    const LookupTable table = someTable();
    const auto at = [&](float x0, float x1, float x2) {
        const std::array<float, 3> x{x0, x1, x2};
        std::array<float, 2> y;
        table.evaluate(x.data(), y.data());
        return y;
    };
    EXPECT_EQ(at(9, 0.3f, 0.1f), at(3, 0.3f, 0.1f));
    EXPECT_EQ(at(-9, -7, 5), at(-2, -1, 2));
    EXPECT_EQ(at(0, 0, std::nanf("")), at(0, 0, -1)) << "what is no number is an end, too";
}

TEST(LookupTables, GradientIsThatOfFiniteDifferences) {
    LookupTable table = someTable();
    const std::size_t count = 300;
    PatternMatrix inputs(count, 3), outputs, slopes(count, 2);
    for (std::size_t i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) inputs(i, k) = static_cast<float>(2.5 * uniform(static_cast<int>(i), k));
    std::vector<float> parameters;
    for (const LookupTable::Grid& grid : table.grids)
        parameters.insert(parameters.end(), grid.values.begin(), grid.values.end());
    const TableGradient gradient(table, inputs);
    ASSERT_EQ(gradient.parameterCount(), parameters.size());
    // L = sum of slope * output + roughness
    for (std::size_t i = 0; i < count; ++i)
        for (int k = 0; k < 2; ++k) slopes(i, k) = static_cast<float>(uniform(static_cast<int>(i), 8 + k));
    std::vector<double> ignored(parameters.size());
    const auto loss = [&] {
        gradient.forward(parameters, outputs);
        double sum = addRoughness(table, parameters, 0.3, ignored);
        for (std::size_t i = 0; i < count; ++i)
            for (int k = 0; k < 2; ++k) sum += static_cast<double>(slopes(i, k)) * static_cast<double>(outputs(i, k));
        return sum;
    };
    std::vector<double> found(parameters.size());
    gradient.backward(slopes, found);
    addRoughness(table, parameters, 0.3, found);
    for (std::size_t p = 0; p < parameters.size(); ++p) {
        constexpr float step = 0.0625f;
        const float kept = parameters[p];
        parameters[p] = kept + step;
        const double above = loss();
        parameters[p] = kept - step;
        const double below = loss();
        parameters[p] = kept;
        EXPECT_NEAR(found[p], (above - below) / (2 * step), 1e-4) << p;
    }
}

TEST(LookupTables, GradientPassesEqualEvaluation) {
    const LookupTable table = someTable();
    PatternMatrix inputs(10, 3), outputs;
    for (std::size_t i = 0; i < 10; ++i)
        for (int k = 0; k < 3; ++k) inputs(i, k) = static_cast<float>(2.5 * uniform(static_cast<int>(i), k));
    std::vector<float> parameters = table.grids[0].values;
    parameters.insert(parameters.end(), table.grids[1].values.begin(), table.grids[1].values.end());
    TableGradient(table, inputs).forward(parameters, outputs);
    const std::vector<float> rows = inputs.toRows();
    for (std::size_t i = 0; i < 10; ++i) {
        std::array<float, 2> y;
        table.evaluate(&rows[3 * i], y.data());
        for (int k = 0; k < 2; ++k) EXPECT_THAT(outputs(i, k), FloatNear(y[static_cast<std::size_t>(k)], 1e-6f));
    }
}

TEST(DecisionTreesTest, AreMeansOfTheirLeaves) {
    const DecisionTrees trees = someTrees();
    const auto at = [&](float x0, float x1) {
        const std::array<float, 2> x{x0, x1};
        std::array<float, 2> y;
        trees.evaluate(x.data(), y.data());
        EXPECT_EQ(y[1], 0) << "no tree is for this output";
        return y[0];
    };
    EXPECT_EQ(at(-2, 0), 2);
    EXPECT_EQ(at(-1, 0.25f), 2) << "at the threshold it goes left";
    EXPECT_EQ(at(0, 0), 3);
    EXPECT_EQ(at(0, 1), 4);
}

/// One of each family, of 3 inputs and 3 outputs, the first of them by itself.
std::vector<Regressor> families() {
    const LookupTable one = tableOf([](float x2, float x0, int) { return x2 * x0; }, [](float x1, int) { return x1; });
    DecisionTrees trees{3, 3, {}};
    for (const DecisionTrees::Tree& tree : someTrees().trees)
        for (int output = 0; output < 3; ++output) trees.trees.push_back({output, tree.nodes});
    return {sideBySide(test::normalNetwork({3, 5, 1}, 1), test::normalNetwork({3, 7, 2}, 2)),
            sideBySide(withOutputs(one, 0, 1), someTable()), trees};
}

std::vector<float> someRows(std::size_t count) {
    std::vector<float> rows;
    for (std::size_t i = 0; i < 3 * count; ++i) rows.push_back(static_cast<float>(2 * uniform(static_cast<int>(i))));
    return rows;
}

TEST(Regressors, GiveTheSameBitsAloneAndInBatches) {
    const std::vector<float> rows = someRows(37);
    for (const Regressor& regressor : families()) {
        const RegressorInference inference(regressor);
        std::vector<float> together(3 * 37), alone(3);
        inference.batch(rows.data(), together.data(), 37);
        for (std::size_t i = 0; i < 37; ++i) {
            inference.one(&rows[3 * i], alone.data());
            EXPECT_TRUE(std::equal(alone.begin(), alone.end(), &together[3 * i])) << nameOf(familyOf(regressor));
        }
    }
}

TEST(Regressors, SideBySideGiveTheOutputsOfBoth) {
    const std::vector<float> rows = someRows(20);
    for (const Regressor& regressor : families()) {
        const RegressorInference all(regressor), first(withOutputs(regressor, 0, 1)),
            rest(withOutputs(regressor, 1, 2));
        ASSERT_EQ(first.outputs(), 1);
        ASSERT_EQ(rest.outputs(), 2);
        const RegressorInference again(sideBySide(withOutputs(regressor, 0, 1), withOutputs(regressor, 1, 2)));
        for (std::size_t i = 0; i < 20; ++i) {
            std::array<float, 3> y, parts, both;
            all.one(&rows[3 * i], y.data());
            first.one(&rows[3 * i], parts.data());
            rest.one(&rows[3 * i], parts.data() + 1);
            again.one(&rows[3 * i], both.data());
            for (std::size_t k = 0; k < 3; ++k) {
                EXPECT_THAT(parts[k], FloatNear(y[k], 1e-5f)) << nameOf(familyOf(regressor));
                EXPECT_THAT(both[k], FloatNear(y[k], 1e-5f)) << nameOf(familyOf(regressor));
            }
        }
    }
}

TEST(Regressors, ReadTheSameAmongMoreInputs) {
    const std::vector<float> rows = someRows(20);
    for (const Regressor& regressor : families()) {
        const std::vector<int> own{1, 2, 4};
        const Regressor wide = amongInputs(regressor, 6, own);
        EXPECT_EQ(inputsOf(wide), 6);
        std::vector<int> read;
        for (const int input : inputsReadBy(regressor)) read.push_back(own[static_cast<std::size_t>(input)]);
        EXPECT_EQ(inputsReadBy(wide), read) << nameOf(familyOf(regressor));
        EXPECT_EQ(withInputs(wide, own), regressor) << nameOf(familyOf(regressor));
        const RegressorInference narrow(regressor), among(wide);
        for (std::size_t i = 0; i < 20; ++i) {
            const float* const x = &rows[3 * i];
            const std::array<float, 6> spread{9, x[0], x[1], -9, x[2], 7};
            std::array<float, 3> expected, found;
            narrow.one(x, expected.data());
            among.one(spread.data(), found.data());
            EXPECT_EQ(found, expected) << nameOf(familyOf(regressor));
        }
    }
}

TEST(Regressors, WithoutOutputsThatNobodyAsksForNeedNoUnitsForThem) {
    const Mlp both = std::get<Mlp>(sideBySide(test::normalNetwork({3, 5, 1}, 1), test::normalNetwork({3, 7, 2}, 2)));
    EXPECT_EQ(std::get<Mlp>(withOutputs(both, 0, 1)).parameters, test::normalNetwork({3, 5, 1}, 1).parameters);
    EXPECT_EQ(std::get<Mlp>(withOutputs(both, 1, 2)).parameters, test::normalNetwork({3, 7, 2}, 2).parameters);
}

// files

LearnedNetwork networkOf(const Regressor& regressor) {
    LearnedNetwork network;
    network.kind = "nose";
    for (int i = 0; i < inputsOf(regressor); ++i) network.inputs.push_back({"in " + std::to_string(i), "1"});
    for (int i = 0; i < outputsOf(regressor); ++i) network.outputs.push_back({"out " + std::to_string(i), "m"});
    network.regressor = regressor;
    return network;
}
std::string textOf(const Regressor& regressor) { return networkFileText(networkOf(regressor), "[nose]\n"); }

Expected<LearnedNetwork> parse(const std::string& text,
                               std::vector<std::string_view> families = {"network", "table", "trees"}) {
    TomlTable root(text, "n.net");
    return readNetworkFile(
        root, "nose", [](TomlTable&, const LearnedNetwork&) {}, families);
}

TEST(RegressorFiles, AreReadBackToTheBit) {
    for (const Regressor& regressor : families()) {
        const auto again = parse(textOf(regressor));
        ASSERT_TRUE(again) << again.error().message();
        EXPECT_TRUE(*again == networkOf(regressor)) << nameOf(familyOf(regressor));
        EXPECT_EQ(networkFileText(*again, "[nose]\n"), textOf(regressor));
    }
    EXPECT_EQ(networkKind(textOf(families().front())), "nose");
    EXPECT_EQ(networkKind("kind = \"nose\"\n"), "");
    EXPECT_EQ(networkKind("]"), "");
}

/// A file in which one thing was replaced.
std::string errorOf(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from << " in\n" << text;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    const auto network = parse(text);
    return network ? "no error" : network.error().message();
}

TEST(RegressorFiles, ThatDoNotFitAreRefused) {
    const std::string table = textOf(someTable()), trees = textOf(someTrees());
    EXPECT_THAT(errorOf(table, "[-1.0, 0.5, 2.0]", "[-1.0, 2.0, 0.5]"), HasSubstr("knots: expected ascending numbers"));
    EXPECT_THAT(errorOf(table, "input = 2", "input = 3"), HasSubstr("input: "));
    EXPECT_THAT(errorOf(table, "family = \"table\"", "family = \"trees\""), HasSubstr("decision_trees"));
    EXPECT_THAT(errorOf(table, "family = \"table\"", "family = \"spline\""), HasSubstr("family: "));
    EXPECT_THAT(errorOf(table, "family = \"table\"\n", ""), HasSubstr("hidden"));
    EXPECT_THAT(errorOf(trees, "[1, 0.25, 1, 2]", "[2, 0.25, 1, 2]"), HasSubstr("nodes: expected inputs from -1 to 1"));
    EXPECT_THAT(errorOf(trees, "[0, -1.0, 3, 4]", "[0, -1.0, 1, 4]"), HasSubstr("must go on at later nodes"));
    EXPECT_THAT(errorOf(trees, "[0, -1.0, 3, 4]", "[0, -1.0, 3, 5]"), HasSubstr("must go on at later nodes"));
    EXPECT_THAT(errorOf(trees, "[0, -1.0, 3, 4]", "[0.5, -1.0, 3, 4]"), HasSubstr("whole numbers"));
    EXPECT_THAT(errorOf(trees, "output = 0", "output = 2"), HasSubstr("output: "));
    const auto other = parse(table, {"network"});
    ASSERT_FALSE(other);
    EXPECT_THAT(other.error().message(), HasSubstr("family: is \"table\"; expected \"network\""));
}

}  // namespace
}  // namespace mrose
