#include "learning/one_step_training.h"

#include <limits>

#include "learning/mlp_gradient.h"

namespace mrose {

namespace {

/// One of the methods, an epoch at a time.
class Fitter {
public:
    Fitter(const MlpShape& shape, const PatternSet& set, const FitOptions& options)
        : options_(options),
          set_(set),
          engine_(shape),
          gradient_(shape.parameterCount()),
          rprop_(shape.parameterCount(), options.rprop),
          levenbergMarquardt_(engine_, set.inputs, set.targets, options.levenbergMarquardt) {}

    /// False if there is nothing better to be found.
    bool epoch(std::vector<float>& parameters) {
        if (options_.method == FitMethod::levenbergMarquardt) {
            const bool better = levenbergMarquardt_.step(parameters);
            error_ = levenbergMarquardt_.loss();
            return better;
        }
        error_ = engine_.meanSquaredError(parameters, set_.inputs, set_.targets, gradient_);
        const double decay = addWeightDecay(engine_.shape(), parameters, options_.weightDecay, gradient_);
        rprop_.step(parameters, gradient_, error_ + decay);
        return true;
    }

    double trainingError() const { return error_; }

    double errorOn(const PatternSet& set, const std::vector<float>& parameters) const {
        return engine_.meanSquaredError(parameters, set.inputs, set.targets);
    }

private:
    const FitOptions& options_;
    const PatternSet& set_;
    MlpGradient engine_;
    std::vector<double> gradient_;
    Rprop rprop_;
    LevenbergMarquardt levenbergMarquardt_;
    double error_ = 0;
};

/// The best network so far, and when to end.
class EarlyStopping {
public:
    EarlyStopping(Mlp& best, const FitOptions& options) : best_(best), options_(options) {}

    void validated(double error, const std::vector<float>& parameters) {
        ++since_;
        if (!(error < error_)) return;
        error_ = error;
        since_ = 0;
        best_.parameters = parameters;
    }

    double error() const { return error_; }
    bool reachedTarget() const { return error_ <= options_.targetError; }
    bool impatient() const { return since_ >= options_.patience; }

private:
    Mlp& best_;
    const FitOptions& options_;
    double error_ = std::numeric_limits<double>::infinity();
    int since_ = 0;
};

}  // namespace

FitSummary fitOneStep(Mlp& net, const PatternSet& training, const PatternSet& validation, const FitOptions& options,
                      const FitCallback& callback) {
    std::vector<float> parameters = net.parameters;
    Fitter fitter(net.shape, training, options);
    EarlyStopping best(net, options);
    best.validated(fitter.errorOn(validation, parameters), parameters);
    FitSummary summary;
    bool going = true;
    while (going && summary.epochs < options.maxEpochs) {
        const bool stuck = !fitter.epoch(parameters);
        ++summary.epochs;
        if (!stuck && summary.epochs % options.validateEvery != 0 && summary.epochs < options.maxEpochs) continue;
        const double error = fitter.errorOn(validation, parameters);
        best.validated(error, parameters);
        const FitProgress progress{summary.epochs, fitter.trainingError(), error, best.error()};
        going = false;
        if (callback && !callback(progress))
            summary.end = FitEnd::stopped;
        else if (best.reachedTarget())
            summary.end = FitEnd::target;
        else if (stuck)
            summary.end = FitEnd::stuck;
        else if (best.impatient())
            summary.end = FitEnd::patience;
        else
            going = true;
    }
    summary.trainingError = fitter.trainingError();
    summary.validationError = best.error();
    return summary;
}

}  // namespace mrose
