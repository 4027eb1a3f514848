#include "learning/trainer.h"

#include <cassert>
#include <cmath>
#include <utility>

namespace mrose {
namespace {

/// One epoch of a method: parameters moved; the loss.
using Epoch = std::function<double(std::span<float> parameters)>;

RpropVariant variantOf(TrainingMethod method) {
    switch (method) {
        case TrainingMethod::irpropMinus:
            return RpropVariant::iRpropMinus;
        case TrainingMethod::rpropPlus:
            return RpropVariant::rpropPlus;
        case TrainingMethod::rpropMinus:
            return RpropVariant::rpropMinus;
        default:
            return RpropVariant::iRpropPlus;
    }
}

Epoch levenbergMarquardtEpochs(const TrainingObjective& objective, const TrainingOptions& options) {
    const PatternSet* const patterns = objective.patterns();
    assert(patterns != nullptr);
    return [optimiser = LevenbergMarquardt(*objective.engine(), patterns->inputs, patterns->targets,
                                           options.levenbergMarquardt)](std::span<float> parameters) mutable {
        optimiser.step(parameters);
        return optimiser.loss();
    };
}

Epoch rpropEpochs(const TrainingObjective& objective, const TrainingOptions& options) {
    RpropOptions rpropOptions = options.rprop;
    rpropOptions.variant = variantOf(options.method);
    const std::size_t count = objective.parameterCount();
    return [&objective, decay = options.weightDecay, rprop = Rprop(count, rpropOptions),
            gradient = std::vector<double>(count)](std::span<float> parameters) mutable {
        const double loss = objective.lossAndGradient(parameters, gradient);
        const double term = decay > 0 ? addWeightDecay(objective.engine()->shape(), parameters, decay, gradient) : 0.0;
        rprop.step(parameters, gradient, loss + term);
        return loss;
    };
}

/// Why training ends after a validation; nothing if it goes on.
bool ends(const TrainingOptions& options, bool goesOn, TrainingResult& result) {
    const auto because = [&](TrainingEnd end) {
        result.end = end;
        return true;
    };
    if (!goesOn) return because(TrainingEnd::stopped);
    if (result.validationError <= options.targetError) return because(TrainingEnd::target);
    if (!std::isfinite(result.loss)) return because(TrainingEnd::diverged);
    if (result.epochs - result.bestEpoch >= options.patience) return because(TrainingEnd::patience);
    return false;
}

}  // namespace

TrainingResult train(TrainingObjective& objective, std::vector<float> parameters, const TrainingOptions& options,
                     const TrainingCallback& callback) {
    assert(parameters.size() == objective.parameterCount());
    const Epoch epoch = options.method == TrainingMethod::levenbergMarquardt
                            ? levenbergMarquardtEpochs(objective, options)
                            : rpropEpochs(objective, options);
    TrainingResult result;
    while (result.epochs < options.epochs) {
        result.loss = epoch(parameters);
        if (++result.epochs % options.validateEvery != 0 && result.epochs < options.epochs) continue;
        const double error = objective.validationError(parameters);
        if (error < result.validationError) {
            result.validationError = error;
            result.bestEpoch = result.epochs;
            result.parameters = parameters;
        }
        const bool goesOn =
            !callback || callback({result.epochs, result.bestEpoch, result.loss, error, result.validationError});
        if (ends(options, goesOn, result)) break;
    }
    return result;
}

}  // namespace mrose
