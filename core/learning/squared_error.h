#pragma once

#include "learning/trainer.h"

namespace mrose {

/// Single steps: the mean squared error over patterns and outputs, of those learned from and of those held out.
class SquaredError final : public TrainingObjective {
public:
    /// Keeps references to the patterns. `set` as in MlpGradient.
    SquaredError(const MlpShape& shape, const PatternSet& training, const PatternSet& heldOut,
                 InstructionSet set = bestInstructionSet())
        : engine_(shape, set), training_(training), heldOut_(heldOut) {}

    const MlpGradient* engine() const override { return &engine_; }
    double lossAndGradient(std::span<const float> parameters, std::span<double> gradient) const override {
        return engine_.meanSquaredError(parameters, training_.inputs, training_.targets, gradient);
    }
    double validationError(std::span<const float> parameters) override {
        return engine_.meanSquaredError(parameters, heldOut_.inputs, heldOut_.targets);
    }
    const PatternSet* patterns() const override { return &training_; }

private:
    MlpGradient engine_;
    const PatternSet& training_;
    const PatternSet& heldOut_;
};

}  // namespace mrose
