#pragma once

#include <span>
#include <vector>

#include "identification/motion_samples.h"
#include "identification/rollout_loss.h"
#include "learning/mlp_gradient.h"

namespace mrose {

/// Starts of chains of `length` consecutive periods, `stride` apart, in each run from its pattern `first(run)` on.
template <class First>
std::vector<std::size_t> chainStarts(const MotionSamples& samples, std::size_t length, std::size_t stride,
                                     First first) {
    std::vector<std::size_t> starts;
    for (const SampleRun& run : samples.runs)
        for (std::size_t i = first(run); i + length <= run.count; i += stride) starts.push_back(run.first + i);
    return starts;
}

/// Many chains of periods driven open loop at once: each step takes the velocity that the step before predicted. The
/// derivative of their loss is backpropagated through time.
class RolloutBatch {
public:
    /// `network` gives form, inputs and scales; its layers are not used. Chains that need no true velocity after their
    /// start, as the history form, read their inputs straight from the samples.
    RolloutBatch(const MotionSamples& samples, const MotionNetwork& network, std::vector<std::size_t> starts,
                 std::size_t length);

    std::size_t chains() const { return starts_.size(); }
    std::size_t length() const { return length_; }
    const std::vector<std::size_t>& starts() const { return starts_; }

    /// Chains begin with the true velocity unless they are told another one. Form state.
    void beginWith(std::size_t chain, const Velocity& velocity);

    /// Predicted increments of all chains [chains][length].
    std::vector<Pose> predict(const MlpGradient& engine, std::span<const float> parameters) const;

    /// Mean loss of the chains; its derivative overwrites `gradient`.
    double lossAndGradient(const MlpGradient& engine, std::span<const float> parameters, const RolloutLoss& loss,
                           std::span<double> gradient) const;

    std::span<const Pose> truth(std::size_t chain) const { return {&truth_[chain * length_], length_}; }

    /// All chains at once, step by step.
    struct Pass {
        std::vector<PatternMatrix> inputs, hidden, outputs;  ///< [step]; inputs only where chains feed them back
        std::vector<Pose> increments;                        ///< [chains][length]
    };
    /// What was read and computed on the way; hidden layers are not kept. `engine` may have more outputs than the
    /// network.
    Pass rollOut(const MlpGradient& engine, std::span<const float> parameters) const {
        return forward(engine, parameters, false);
    }
    const PatternMatrix& inputs(const Pass& pass, std::size_t step) const {
        return recurrent_ ? pass.inputs[step] : inputs_[step];
    }

private:
    Pass forward(const MlpGradient& engine, std::span<const float> parameters, bool keepHidden) const;
    double addVelocityError(const Pass& pass, std::size_t chain, double weight,
                            std::vector<PatternMatrix>& byOutput) const;
    void takeVelocity(const PatternMatrix& outputs, PatternMatrix& inputs) const;
    void returnVelocity(const PatternMatrix& inputGradient, PatternMatrix& outputGradient) const;

    const MotionNetwork& network_;
    std::vector<std::size_t> starts_;
    std::size_t length_;
    bool recurrent_;
    std::vector<PatternMatrix> inputs_;  ///< one for each step of the chains
    std::vector<Pose> truth_;
    std::vector<PatternMatrix> velocities_;      ///< (v', w') in units of the outputs, for each step; if recurrent
    std::vector<std::pair<int, int>> feedback_;  ///< input that reads a velocity, output that predicts it
};

/// P and Hd, in %; 0 where nothing drove or turned.
struct OpenLoopError {
    double position = 0, heading = 0;
    std::int64_t windows = 0;
};
OpenLoopError openLoopError(const RolloutBatch& batch, std::span<const Pose> predicted, Nanoseconds period);

}  // namespace mrose
