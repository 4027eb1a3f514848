#include "learning/task_network.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "learning/nearest_neighbours.h"
#include "plugin/network_mapping.h"
#include "plugin/plugin.h"
#include "world/noise.h"

namespace mrose {
namespace {

using testing::HasSubstr;

/// Two neighbours of three points on a line; the output is a logarithm.
TaskNetwork small() {
    TaskNetwork network;
    network.learned.kind = TaskNetwork::kind;
    network.learned.inputs = {{"a", "m", 1, 2}, {"b", "m", 0, 1}};
    network.learned.outputs = {{"t", "s", 0, 1}};
    network.learned.regressor = NearestNeighbours{2, 1, 1, {0}, {0, 1, 2}, {0, 1, 2}};
    network.seen = {{-1, 5}, {0, 1}};
    network.logarithmic = {true};
    return network;
}

std::string refusal(const std::string& from, const std::string& to) {
    std::string text = taskFileText(small());
    EXPECT_NE(text.find(from), std::string::npos) << text;
    text.replace(text.find(from), from.size(), to);
    const auto read = parseTask(text, "t.net");
    return read ? "" : read.error().message();
}

TEST(TaskNetworkTest, GivesWhatItHolds) {
    const TaskInference inference(small());
    const double nearest[] = {3.1, 0.5};  // 1.05 of a's scale from its mean
    double t = 0;
    inference.evaluate(nearest, &t);
    EXPECT_DOUBLE_EQ(t, std::exp(1.0));
    EXPECT_EQ(inference.beyond(nearest), 0);
    const double left[] = {-4, 0.5}, above[] = {5, 1.25};
    EXPECT_DOUBLE_EQ(inference.beyond(left), 3.0 / 6);
    EXPECT_DOUBLE_EQ(inference.beyond(above), 0.25);
}

TEST(TaskNetworkTest, WhatIsWrongInAFileIsToldWithItsPlace) {
    EXPECT_EQ(refusal("[task]", "[task]"), "");
    EXPECT_THAT(refusal("[-1.0, 5.0]", "[5.0, -1.0]"), HasSubstr("seen[1]: expected the least before the most"));
    EXPECT_THAT(refusal("logarithmic = [0]", "logarithmic = [1]"),
                HasSubstr("logarithmic: expected numbers of outputs"));
    EXPECT_THAT(refusal("neighbours = 1", "neighbours = 4"), HasSubstr("neighbours: are more than there are patterns"));
    EXPECT_THAT(refusal("neighbours = 1", "neighbours = 65"),
                HasSubstr("neighbours: expected a whole number from 1 to 64"));
    EXPECT_THAT(refusal("read = [0]", "read = [2]"), HasSubstr("read"));
    EXPECT_THAT(refusal("read = [0]", "read = [0, 0]"), HasSubstr("read: expected ascending whole numbers"));
    EXPECT_THAT(refusal("kind = \"task\"", "kind = \"motion\""), HasSubstr("kind: is a network of another kind"));
}

/// Beside all distances, sorted.
TEST(NearestNeighboursTest, AreTheNearest) {
    NearestNeighbours of{3, 2, 4, {0, 2}, {}, {}};
    for (int p = 0; p < 200; ++p) {
        const UniformDraws u({3, p, 0, 0});
        of.points.insert(of.points.end(), {static_cast<float>(u[0]), static_cast<float>(u[1])});
        of.values.insert(of.values.end(), {static_cast<float>(u[2]), static_cast<float>(p)});
    }
    for (int k = 0; k < 50; ++k) {
        const UniformDraws u({4, k, 0, 0});
        const float x[] = {static_cast<float>(u[0]), 7, static_cast<float>(u[1])};
        std::vector<std::pair<float, std::size_t>> all;
        for (std::size_t p = 0; p < 200; ++p)
            all.emplace_back(std::hypot(x[0] - of.points[2 * p], x[2] - of.points[2 * p + 1]), p);
        std::sort(all.begin(), all.end());
        double sum = 0, expected[2] = {};
        for (std::size_t i = 0; i < 4; ++i) {
            const double weight = 1 / (1e-6 + static_cast<double>(all[i].first));
            sum += weight;
            for (std::size_t o = 0; o < 2; ++o)
                expected[o] += weight * static_cast<double>(of.values[2 * all[i].second + o]);
        }
        float y[2];
        of.evaluate(x, y);
        for (int o = 0; o < 2; ++o)
            EXPECT_NEAR(static_cast<double>(y[o]), expected[o] / sum, 1e-4 * (1 + std::abs(expected[o] / sum)));
    }
}

/// Options that name one mapping.
class OneMapping final : public PluginOptions {
public:
    double number(const char*, double fallback) override { return fallback; }
    bool flag(const char*, bool fallback) override { return fallback; }
    std::string text(const char*, const char* fallback) override { return fallback; }
    const LearnedMapping* mapping(const char* key) override { return std::string(key) == "time" ? &mapping_ : nullptr; }
    const PluginLandmark* landmark(std::uint32_t) override { return nullptr; }
    void reject(const char* key, const char* cause) override { rejected = std::string(key) + ": " + cause; }
    using PluginOptions::mapping;

    std::string rejected;

private:
    NetworkMapping mapping_{small()};
};

TEST(TaskNetworkTest, PluginAsksForItByNames) {
    OneMapping options;
    EXPECT_NE(options.mapping("time", {"a", "b"}, {"t"}), nullptr);
    EXPECT_EQ(options.rejected, "");
    EXPECT_EQ(options.mapping("none", {"a", "b"}, {"t"}), nullptr);
    EXPECT_EQ(options.rejected, "");
    EXPECT_EQ(options.mapping("time", {"b", "a"}, {"t"}), nullptr);
    EXPECT_EQ(options.rejected, "time: maps a b -> t; expected b a -> t");
}

TEST(TaskNetworkTest, PluginSaysWhereItWillAskForIt) {
    const TaskNetwork::Range a = small().seen[0], b = small().seen[1];
    OneMapping options;
    EXPECT_NE(options.mapping("time", {{"a", a.least, a.most}, "b"}, {"t"}), nullptr);
    EXPECT_NE(options.mapping("time", {"a", {"b", b.least - 0.04 * (b.most - b.least), b.most}}, {"t"}), nullptr);
    EXPECT_EQ(options.rejected, "");
    EXPECT_EQ(options.mapping("time", {"a", {"b", b.least - 0.06 * (b.most - b.least), b.most}}, {"t"}), nullptr);
    EXPECT_THAT(options.rejected, testing::StartsWith("time: was learned at b from "));
    options.rejected.clear();
    EXPECT_EQ(options.mapping("time", {{"a", a.least, a.most + 1e6}, "b"}, {"t"}), nullptr);
    EXPECT_THAT(options.rejected, testing::HasSubstr("to 1e+06"));
}

}  // namespace
}  // namespace mrose
