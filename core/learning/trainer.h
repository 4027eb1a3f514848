#pragma once

#include <array>
#include <functional>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "learning/levenberg_marquardt.h"
#include "learning/mlp_gradient.h"
#include "learning/pattern_set.h"
#include "learning/rprop.h"

namespace mrose {

/// What a network is trained for: data with a loss to be made small, and data held out from it, by whose error the best
/// network is chosen. Single steps (SquaredError), rollouts, the likelihood of a mixture ...
class TrainingObjective {
public:
    virtual ~TrainingObjective() = default;

    /// What computes the network, and says its shape; null of what is none, which has neither weights that decay nor
    /// Levenberg and Marquardt's method.
    virtual const MlpGradient* engine() const = 0;
    virtual std::size_t parameterCount() const { return engine()->shape().parameterCount(); }

    /// The loss over the data that are learned from; its derivative by the parameters overwrites `gradient`.
    virtual double lossAndGradient(std::span<const float> parameters, std::span<double> gradient) const = 0;

    /// The error on the data held out; the smaller the better, NaN is none. Not const, so that an objective may keep
    /// more of it than the number.
    virtual double validationError(std::span<const float> parameters) = 0;

    /// The patterns whose mean squared error the loss is, which Levenberg and Marquardt's method needs; null for any
    /// other loss.
    virtual const PatternSet* patterns() const { return nullptr; }
};

enum class TrainingMethod { irpropPlus, irpropMinus, rpropPlus, rpropMinus, levenbergMarquardt };
/// By TrainingMethod: as command lines and network files name them.
constexpr std::array<std::string_view, 5> trainingMethodNames{"irprop+", "irprop-", "rprop+", "rprop-", "lm"};
constexpr std::string_view nameOf(TrainingMethod method) {
    return trainingMethodNames[static_cast<std::size_t>(method)];
}

struct TrainingOptions {
    TrainingMethod method = TrainingMethod::irpropPlus;  ///< levenbergMarquardt: of an objective with patterns
    RpropOptions rprop = {};                             ///< but for the variant, which is the method's
    LevenbergMarquardtOptions levenbergMarquardt = {};
    double weightDecay = 0;  ///< with RPROP: this times the sum of squared weights is added to the loss
    int epochs = 2000;       ///< at most
    int validateEvery = 10;  ///< epochs; after the last one too
    int patience = 500;      ///< epochs without a better validation error after which training ends
    double targetError = -std::numeric_limits<double>::infinity();  ///< validation error at which it ends
};

struct TrainingProgress {
    int epoch = 0, bestEpoch = 0;  ///< 0: no validation gave an error yet
    double loss = 0;
    double validationError = 0, bestValidationError = 0;
};

/// Called after every validation; false ends training.
using TrainingCallback = std::function<bool(const TrainingProgress&)>;

enum class TrainingEnd {
    epochs,    ///< all of them done
    target,    ///< the target error reached
    patience,  ///< no better validation error for a long time
    stopped,   ///< by the caller
    diverged   ///< the loss is not a finite number
};

struct TrainingResult {
    std::vector<float> parameters;  ///< of the least validation error; empty if none was a number
    double validationError = std::numeric_limits<double>::infinity();  ///< theirs
    double loss = 0;                                                   ///< of the last epoch
    int epochs = 0, bestEpoch = 0;
    TrainingEnd end = TrainingEnd::epochs;
};

/// Trains a network, in Mlp's order of parameters, or what else the objective is of, from those given. Deterministic;
/// threads as in MlpGradient.
TrainingResult train(TrainingObjective& objective, std::vector<float> parameters, const TrainingOptions& options = {},
                     const TrainingCallback& callback = {});

}  // namespace mrose
