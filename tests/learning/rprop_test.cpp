#include "learning/rprop.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace mrose {
namespace {

const RpropVariant kVariants[] = {RpropVariant::rpropPlus, RpropVariant::rpropMinus, RpropVariant::iRpropPlus,
                                  RpropVariant::iRpropMinus};

/// One weight by the published rules, case by case, in double.
struct ReferenceWeight {
    double w, size = 0.1, lastG = 0, lastDw = 0;

    void step(RpropVariant variant, double g, bool rose) {
        const double s = g * lastG;
        const double sign = g > 0 ? 1 : g < 0 ? -1 : 0;
        if (s > 0) {
            size = std::min(1.2 * size, 50.0);
            move(-sign * size, g);
        } else if (s == 0) {
            move(-sign * size, g);
        } else {
            size = std::max(0.5 * size, 1e-6);
            switch (variant) {
                case RpropVariant::rpropPlus:
                    return move(-lastDw, 0);
                case RpropVariant::rpropMinus:
                    return move(-sign * size, g);
                case RpropVariant::iRpropPlus:
                    return rose ? move(-lastDw, 0) : move(0, 0);
                case RpropVariant::iRpropMinus:
                    return move(0, 0);
            }
        }
    }

    void move(double dw, double g) {
        w += dw;
        lastDw = dw;
        lastG = g;
    }
};

TEST(Rprop, FollowsThePublishedRulesOnAQuadraticInEveryVariant) {
    for (const RpropVariant variant : kVariants) {
        const double curvature[3] = {1, 30, 0.2}, minimum[3] = {1.3, -0.7, 12};
        ReferenceWeight reference[3] = {{0}, {0}, {0}};
        std::vector<float> w(3);
        Rprop rprop(3, {.variant = variant});
        double lastLoss = INFINITY;
        for (int epoch = 0; epoch < 120; ++epoch) {
            double loss = 0;
            std::vector<double> g(3);
            for (int i = 0; i < 3; ++i) {
                g[i] = curvature[i] * (reference[i].w - minimum[i]);
                loss += g[i] * g[i] / curvature[i] / 2;
            }
            for (int i = 0; i < 3; ++i) reference[i].step(variant, g[i], loss > lastLoss);
            rprop.step(w, g, loss);
            lastLoss = loss;
            for (int i = 0; i < 3; ++i) {
                ASSERT_NEAR(w[i], reference[i].w, 1e-4) << static_cast<int>(variant) << ' ' << epoch;
                ASSERT_DOUBLE_EQ(rprop.stepSizes()[i], reference[i].size);
            }
        }
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(w[i], minimum[i], 1e-2) << static_cast<int>(variant);
    }
}

/// The weight after each of a sequence of (gradient, loss), from 0 on.
std::vector<float> path(RpropVariant variant, const std::vector<std::pair<double, double>>& steps) {
    Rprop rprop(1, {.variant = variant});
    std::vector<float> w = {0}, places;
    for (const auto& [gradient, loss] : steps) {
        rprop.step(w, {&gradient, 1}, loss);
        places.push_back(w[0]);
    }
    return places;
}

void expectPath(RpropVariant variant, const std::vector<std::pair<double, double>>& steps,
                const std::vector<double>& expected) {
    const std::vector<float> places = path(variant, steps);
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(places[i], expected[i], 1e-6) << "step " << i;
}

// by hand: steps of 0.1, then 0.12; the sign changes, the size becomes 0.06; then a step of 0.06 either way

TEST(Rprop, PlusTakesTheLastStepBackWhenTheSignChanges) {
    expectPath(RpropVariant::rpropPlus, {{-1, 9}, {-1, 8}, {1, 7}, {1, 8}}, {0.1, 0.22, 0.1, 0.04});
}

TEST(Rprop, MinusStepsOnWithTheShorterStep) {
    expectPath(RpropVariant::rpropMinus, {{-1, 9}, {-1, 8}, {1, 7}, {1, 6}}, {0.1, 0.22, 0.16, 0.088});
}

TEST(Rprop, ImprovedPlusTakesTheLastStepBackOnlyIfTheLossRose) {
    expectPath(RpropVariant::iRpropPlus, {{-1, 9}, {-1, 8}, {1, 8.5}, {1, 8}}, {0.1, 0.22, 0.1, 0.04});
    expectPath(RpropVariant::iRpropPlus, {{-1, 9}, {-1, 8}, {1, 7}, {1, 6}}, {0.1, 0.22, 0.22, 0.16});
}

TEST(Rprop, ImprovedMinusWaitsOnceWhenTheSignChanges) {
    expectPath(RpropVariant::iRpropMinus, {{-1, 9}, {-1, 8}, {1, 8.5}, {1, 8}}, {0.1, 0.22, 0.22, 0.16});
}

TEST(Rprop, StandsStillWhereTheGradientIsZero) {
    for (const RpropVariant variant : kVariants) expectPath(variant, {{0, 1}, {0, 1}}, {0, 0});
}

TEST(Rprop, KeepsStepsBetweenTheirLimits) {
    for (const RpropVariant variant : kVariants) {
        Rprop grows(1, {.variant = variant}), shrinks(1, {.variant = variant});
        std::vector<float> w = {0};
        double gradient = 1;
        for (int i = 0; i < 100; ++i) grows.step(w, {&gradient, 1}, -i);
        EXPECT_EQ(grows.stepSizes()[0], 50);
        for (int i = 0; i < 100; ++i) {
            gradient = i % 2 ? 1 : -1;
            shrinks.step(w, {&gradient, 1}, i);
        }
        EXPECT_EQ(shrinks.stepSizes()[0], 1e-6);
    }
}

}  // namespace
}  // namespace mrose
