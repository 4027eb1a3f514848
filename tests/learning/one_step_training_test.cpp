#include "learning/one_step_training.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "learning/initial_weights.h"
#include "learning/mlp_gradient.h"
#include "learning/reference_network.h"

namespace mrose {
namespace {

const MlpShape kShape{2, 10, 2};

/// A smooth function with noise that cannot be learned.
PatternSet noisyPatterns(std::size_t patterns, unsigned seed, float noise) {
    PatternSet set{test::normalPatterns(patterns, 2, seed), test::normalPatterns(patterns, 2, seed + 1)};
    for (std::size_t p = 0; p < patterns; ++p) {
        const float x = set.inputs(p, 0), y = set.inputs(p, 1);
        set.targets(p, 0) = noise * set.targets(p, 0) + std::sin(x + y);
        set.targets(p, 1) = noise * set.targets(p, 1) + x * std::exp(-y * y);
    }
    return set;
}

TEST(FitOneStep, LearnsASmoothFunctionByEveryMethod) {
    const PatternSet training = noisyPatterns(2000, 1, 0.02f), validation = noisyPatterns(500, 5, 0.02f);
    std::vector<FitOptions> methods(5);
    for (int variant = 0; variant < 4; ++variant) methods[variant].rprop.variant = static_cast<RpropVariant>(variant);
    methods[4].method = FitMethod::levenbergMarquardt;
    methods[4].maxEpochs = 100;
    for (std::size_t i = 0; i < methods.size(); ++i) {
        Mlp net = randomMlp(kShape);
        const FitSummary summary = fitOneStep(net, training, validation, methods[i]);
        EXPECT_LT(summary.validationError, 0.01) << "method " << i;  // the variance of the targets is near 0.3
        const double error =
            MlpGradient(kShape).meanSquaredError(net.parameters, validation.inputs, validation.targets);
        EXPECT_EQ(summary.validationError, error) << "method " << i;
    }
}

TEST(FitOneStep, GivesBackTheNetworkOfTheLeastValidationErrorAndLosesPatience) {
    const PatternSet training = noisyPatterns(40, 1, 0.5f), validation = noisyPatterns(300, 5, 0.5f);
    Mlp net = randomMlp(kShape);
    double least = INFINITY, last = 0;
    const FitSummary summary =
        fitOneStep(net, training, validation, {.maxEpochs = 5000, .patience = 20}, [&](const FitProgress& progress) {
            least = std::min(least, progress.validationError);
            last = progress.validationError;
            EXPECT_LE(progress.bestValidationError, least);
            return true;
        });
    EXPECT_EQ(summary.end, FitEnd::patience);
    EXPECT_LT(summary.epochs, 5000);
    EXPECT_LE(summary.validationError, least);
    EXPECT_GT(last, summary.validationError) << "the test needs a fit that learns by heart";
}

TEST(FitOneStep, EndsWhenTheCallerSaysSo) {
    const PatternSet set = noisyPatterns(100, 1, 0.1f);
    Mlp net = randomMlp(kShape);
    const FitSummary summary = fitOneStep(net, set, set, {.validateEvery = 7},
                                          [](const FitProgress& progress) { return progress.epoch < 14; });
    EXPECT_EQ(summary.end, FitEnd::stopped);
    EXPECT_EQ(summary.epochs, 14);
}

TEST(FitOneStep, EndsAtTheTargetAndAtTheLastEpoch) {
    const PatternSet set = noisyPatterns(500, 1, 0.02f);
    Mlp net = randomMlp(kShape);
    const FitSummary first = fitOneStep(net, set, set, {.targetError = 0.1});
    EXPECT_EQ(first.end, FitEnd::target);
    EXPECT_LE(first.validationError, 0.1);
    const FitSummary second = fitOneStep(net, set, set, {.maxEpochs = 3});
    EXPECT_EQ(second.end, FitEnd::epochs);
    EXPECT_EQ(second.epochs, 3);
    EXPECT_LE(second.validationError, first.validationError);
}

TEST(FitOneStep, KeepsWeightsSmallerUnderDecay) {
    const PatternSet set = noisyPatterns(200, 1, 0.3f);
    const auto squaredWeights = [&](double decay) {
        Mlp net = randomMlp(kShape);
        fitOneStep(net, set, set, {.weightDecay = decay, .maxEpochs = 500});
        std::vector<double> unused(net.parameters.size());
        return addWeightDecay(kShape, net.parameters, 1, unused);
    };
    EXPECT_LT(squaredWeights(1e-2), 0.5 * squaredWeights(0));
}

TEST(FitOneStep, DoesNotDependOnTheNumberOfThreads) {
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 8);
    const PatternSet training = noisyPatterns(3000, 1, 0.1f), validation = noisyPatterns(300, 5, 0.1f);
    for (const FitMethod method : {FitMethod::rprop, FitMethod::levenbergMarquardt}) {
        const auto run = [&](int threads) {
            tbb::task_arena arena(threads);
            Mlp net = randomMlp(kShape);
            arena.execute([&] { fitOneStep(net, training, validation, {.method = method, .maxEpochs = 40}); });
            return net;
        };
        EXPECT_EQ(run(1), run(2));
        EXPECT_EQ(run(1), run(8));
    }
}

}  // namespace
}  // namespace mrose
