#pragma once

#include <functional>

#include "learning/levenberg_marquardt.h"
#include "learning/mlp.h"
#include "learning/pattern_matrix.h"
#include "learning/rprop.h"

namespace mrose {

/// Inputs and the outputs wanted for them, pattern by pattern, standardised.
struct PatternSet {
    PatternMatrix inputs, targets;
};

enum class FitMethod { rprop, levenbergMarquardt };

enum class FitEnd {
    epochs,    ///< all of them done
    target,    ///< the target error reached
    patience,  ///< no better validation error for a long time
    stuck,     ///< the method finds nothing better
    stopped    ///< by the caller
};

struct FitOptions {
    FitMethod method = FitMethod::rprop;
    RpropOptions rprop = {};
    LevenbergMarquardtOptions levenbergMarquardt = {};
    double weightDecay = 0;  ///< with RPROP: this times the sum of squared weights is added to the mean squared error
    int maxEpochs = 2000;
    int validateEvery = 10;  ///< epochs
    int patience = 50;       ///< validations without a better error before the fit ends
    double targetError = 0;  ///< validation error at which the fit ends
};

/// Mean squared errors over patterns and outputs.
struct FitProgress {
    int epoch = 0;
    double trainingError = 0, validationError = 0, bestValidationError = 0;
};

struct FitSummary {
    int epochs = 0;
    double trainingError = 0;    ///< at the last epoch
    double validationError = 0;  ///< of the network given back
    FitEnd end = FitEnd::epochs;
};

/// Called after every validation; false ends the fit.
using FitCallback = std::function<bool(const FitProgress&)>;

/// Fits `net` to single steps, from the parameters that it has. It becomes the network of the least validation error.
/// Deterministic; threads as in MlpGradient.
FitSummary fitOneStep(Mlp& net, const PatternSet& training, const PatternSet& validation,
                      const FitOptions& options = {}, const FitCallback& callback = {});

}  // namespace mrose
