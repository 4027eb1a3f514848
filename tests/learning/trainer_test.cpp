#include "learning/trainer.h"

#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "learning/initial_weights.h"
#include "learning/reference_network.h"
#include "learning/squared_error.h"

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

std::vector<float> start() { return randomMlp(kShape).parameters; }

/// A loss of one's own: -ln of a normal density whose mean and ln of deviation a network gives, of one target.
class NormalLikelihood final : public TrainingObjective {
public:
    explicit NormalLikelihood(PatternSet patterns) : engine_({1, 6, 2}), patterns_(std::move(patterns)) {}

    const MlpGradient* engine() const override { return &engine_; }
    double lossAndGradient(std::span<const float> parameters, std::span<double> gradient) const override {
        PatternMatrix outputs;
        engine_.forward(parameters, patterns_.inputs, outputs);
        PatternMatrix byOutput(outputs.patterns(), 2);
        const double share = 1 / double(outputs.patterns());
        double loss = 0;
        for (std::size_t p = 0; p < outputs.patterns(); ++p) {
            const double z = (patterns_.targets(p, 0) - outputs(p, 0)) / std::exp(outputs(p, 1));
            loss += share * (outputs(p, 1) + 0.5 * z * z);
            byOutput(p, 0) = float(-share * z / std::exp(outputs(p, 1)));
            byOutput(p, 1) = float(share * (1 - z * z));
        }
        std::fill(gradient.begin(), gradient.end(), 0);
        engine_.backward(parameters, patterns_.inputs, byOutput, gradient);
        return loss;
    }
    double validationError(std::span<const float> parameters) override {
        std::vector<double> unused(parameters.size());
        return lossAndGradient(parameters, unused);
    }
    std::pair<double, double> meanAndDeviation(std::span<const float> parameters, float x) const {
        PatternMatrix input(1, 1), output;
        input(0, 0) = x;
        engine_.forward(parameters, input, output);
        return {output(0, 0), std::exp(output(0, 1))};
    }

private:
    MlpGradient engine_;
    PatternSet patterns_;
};

TEST(Train, LearnsASmoothFunctionByEveryMethod) {
    const PatternSet training = noisyPatterns(2000, 1, 0.02f), validation = noisyPatterns(500, 5, 0.02f);
    for (std::size_t i = 0; i < trainingMethodNames.size(); ++i) {
        TrainingOptions options;
        options.method = static_cast<TrainingMethod>(i);
        if (options.method == TrainingMethod::levenbergMarquardt) options.epochs = 100;
        SquaredError objective(kShape, training, validation);
        const TrainingResult result = train(objective, start(), options);
        EXPECT_LT(result.validationError, 0.01) << nameOf(options.method);  // the targets' variance is near 0.3
        EXPECT_EQ(result.validationError, objective.validationError(result.parameters)) << nameOf(options.method);
    }
}

TEST(Train, LearnsTheSameNetworkOnEveryInstructionSetByEveryMethod) {
    const PatternSet training = noisyPatterns(1000, 1, 0.02f), validation = noisyPatterns(300, 5, 0.02f);
    for (std::size_t i = 0; i < trainingMethodNames.size(); ++i) {
        const TrainingOptions options{.method = static_cast<TrainingMethod>(i), .weightDecay = 1e-6, .epochs = 60};
        const auto learnedOn = [&](InstructionSet set) {
            SquaredError objective(kShape, training, validation, set);
            return train(objective, start(), options);
        };
        const TrainingResult baseline = learnedOn(InstructionSet::baseline);
        EXPECT_NE(baseline.parameters, start()) << nameOf(options.method);
        for (const InstructionSet set : availableInstructionSets()) {
            const TrainingResult result = learnedOn(set);
            EXPECT_EQ(result.parameters, baseline.parameters) << nameOf(options.method) << ", " << name(set);
            EXPECT_EQ(result.loss, baseline.loss) << nameOf(options.method) << ", " << name(set);
        }
    }
}

TEST(Train, EveryMethodIsItsOwn) {
    const PatternSet set = noisyPatterns(300, 1, 0.02f);
    std::set<double> losses;
    for (std::size_t i = 0; i < trainingMethodNames.size(); ++i) {
        SquaredError objective(kShape, set, set);
        losses.insert(train(objective, start(), {.method = static_cast<TrainingMethod>(i), .epochs = 40}).loss);
    }
    EXPECT_EQ(losses.size(), trainingMethodNames.size());
}

TEST(Train, ALossOfOnesOwnIsMadeSmallByTheSameLoop) {
    PatternSet set{test::normalPatterns(20000, 1, 3), test::normalPatterns(20000, 1, 4)};
    for (std::size_t p = 0; p < set.inputs.patterns(); ++p) {
        set.inputs(p, 0) = std::tanh(set.inputs(p, 0));
        set.targets(p, 0) = set.inputs(p, 0) + 0.1f * std::exp(set.inputs(p, 0)) * set.targets(p, 0);
    }
    NormalLikelihood objective(std::move(set));
    const TrainingResult result =
        train(objective, randomMlp({1, 6, 2}).parameters, {.rprop = {.firstStep = 0.01}, .epochs = 600});
    EXPECT_LT(result.validationError, 0) << "a likelihood has no least value of 0 at which training could end";
    for (const float x : {-0.7f, 0.0f, 0.7f}) {
        const auto [mean, deviation] = objective.meanAndDeviation(result.parameters, x);
        EXPECT_NEAR(mean, x, 0.02) << x;
        EXPECT_NEAR(deviation / (0.1 * std::exp(x)), 1, 0.1) << x;
    }
}

TEST(Train, GivesTheNetworkOfTheLeastValidationErrorAndLosesPatience) {
    const PatternSet training = noisyPatterns(40, 1, 0.5f), validation = noisyPatterns(300, 5, 0.5f);
    SquaredError objective(kShape, training, validation);
    double least = INFINITY, last = 0;
    int best = 0;
    const TrainingResult result =
        train(objective, start(), {.epochs = 5000, .patience = 200}, [&](const TrainingProgress& progress) {
            if (progress.validationError < least) best = progress.epoch;
            least = std::min(least, progress.validationError);
            last = progress.validationError;
            EXPECT_EQ(progress.bestValidationError, least);
            EXPECT_EQ(progress.bestEpoch, best);
            return true;
        });
    EXPECT_EQ(result.end, TrainingEnd::patience);
    EXPECT_EQ(result.epochs, best + 200);
    EXPECT_EQ(result.bestEpoch, best);
    EXPECT_EQ(result.validationError, least);
    EXPECT_EQ(objective.validationError(result.parameters), least);
    EXPECT_GT(last, result.validationError) << "the test needs a fit that learns by heart";
}

TEST(Train, EndsWhenTheCallerSaysSo) {
    const PatternSet set = noisyPatterns(100, 1, 0.1f);
    SquaredError objective(kShape, set, set);
    const TrainingResult result = train(objective, start(), {.validateEvery = 7},
                                        [](const TrainingProgress& progress) { return progress.epoch < 14; });
    EXPECT_EQ(result.end, TrainingEnd::stopped);
    EXPECT_EQ(result.epochs, 14);
    EXPECT_FALSE(result.parameters.empty());
}

TEST(Train, EndsAtTheTargetAndAtTheLastEpoch) {
    const PatternSet set = noisyPatterns(500, 1, 0.02f);
    SquaredError objective(kShape, set, set);
    const TrainingResult first = train(objective, start(), {.targetError = 0.1});
    EXPECT_EQ(first.end, TrainingEnd::target);
    EXPECT_LE(first.validationError, 0.1);
    EXPECT_LT(first.epochs, 2000);
    int validations = 0;
    const TrainingResult second = train(objective, start(), {.epochs = 13}, [&](const TrainingProgress&) {
        ++validations;
        return true;
    });
    EXPECT_EQ(second.end, TrainingEnd::epochs);
    EXPECT_EQ(second.epochs, 13);
    EXPECT_EQ(validations, 2) << "after epoch 10, and after the last one";
}

TEST(Train, EndsWhereTheLossIsNoNumber) {
    PatternSet set = noisyPatterns(100, 1, 0.1f);
    set.targets(17, 0) = NAN;
    const PatternSet sound = noisyPatterns(100, 1, 0.1f);
    SquaredError toNothing(kShape, set, set), judgedSoundly(kShape, set, sound);
    const TrainingResult nothing = train(toNothing, start());
    EXPECT_EQ(nothing.end, TrainingEnd::diverged);
    EXPECT_EQ(nothing.epochs, 10);
    EXPECT_TRUE(nothing.parameters.empty());
    EXPECT_EQ(train(judgedSoundly, start()).end, TrainingEnd::diverged);
}

TEST(Train, KeepsWeightsSmallerUnderDecay) {
    const PatternSet set = noisyPatterns(200, 1, 0.3f);
    const auto squaredWeights = [&](double decay) {
        SquaredError objective(kShape, set, set);
        const std::vector<float> parameters =
            train(objective, start(), {.weightDecay = decay, .epochs = 500}).parameters;
        std::vector<double> unused(parameters.size());
        return addWeightDecay(kShape, parameters, 1, unused);
    };
    EXPECT_LT(squaredWeights(1e-2), 0.5 * squaredWeights(0));
}

TEST(Train, DoesNotDependOnTheNumberOfThreads) {
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 8);
    const PatternSet training = noisyPatterns(3000, 1, 0.1f), validation = noisyPatterns(300, 5, 0.1f);
    for (const TrainingMethod method : {TrainingMethod::irpropPlus, TrainingMethod::levenbergMarquardt}) {
        const auto run = [&](int threads) {
            tbb::task_arena arena(threads);
            SquaredError objective(kShape, training, validation);
            TrainingResult result;
            arena.execute([&] { result = train(objective, start(), {.method = method, .epochs = 40}); });
            return result.parameters;
        };
        EXPECT_EQ(run(1), run(2));
        EXPECT_EQ(run(1), run(8));
    }
}

}  // namespace
}  // namespace mrose
