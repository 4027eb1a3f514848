#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>

#include "learning/instruction_set.h"
#include "learning/mlp.h"
#include "learning/pattern_matrix.h"

namespace mrose {

struct TrainingKernel;

/// Loss and gradient of a network over a whole batch, with float activations and double sums. Runs in the oneTBB arena
/// of its caller; the results depend neither on the number of threads nor on the instruction set. Parameters are those
/// of Mlp; gradients have the same order and parameterCount() doubles. One object may be used by several threads.
class MlpGradient {
public:
    /// `set` must be available.
    explicit MlpGradient(MlpShape shape, InstructionSet set = bestInstructionSet());
    ~MlpGradient();
    MlpGradient(MlpGradient&&) noexcept;
    MlpGradient& operator=(MlpGradient&&) noexcept;

    const MlpShape& shape() const { return shape_; }
    InstructionSet instructionSet() const { return set_; }

    /// Mean of (output - target)^2 over patterns and outputs.
    double meanSquaredError(std::span<const float> parameters, const PatternMatrix& inputs,
                            const PatternMatrix& targets) const;

    /// The same, and its gradient, which is overwritten: the fast way to fit single steps.
    double meanSquaredError(std::span<const float> parameters, const PatternMatrix& inputs,
                            const PatternMatrix& targets, std::span<double> gradient) const;

    /// Any other loss L, first half: the outputs (resized). `hidden`, if given, keeps the activations for backward().
    void forward(std::span<const float> parameters, const PatternMatrix& inputs, PatternMatrix& outputs,
                 PatternMatrix* hidden = nullptr) const;

    /// Second half: dL/doutputs -> dL/dparameters, ADDED to `gradient`, so that calls for the steps of a rollout sum
    /// up. `hidden` from forward() with the same arguments saves computing it again. `inputGradient`, if given, becomes
    /// dL/dinputs: what backpropagation through time carries to the step before.
    void backward(std::span<const float> parameters, const PatternMatrix& inputs, const PatternMatrix& outputGradient,
                  std::span<double> gradient, const PatternMatrix* hidden = nullptr,
                  PatternMatrix* inputGradient = nullptr) const;

private:
    struct Workspace;
    struct Worker;

    using BlockWork = std::function<void(Worker&, std::size_t block)>;

    /// Calls work for all blocks, on several threads.
    void forBlocks(std::size_t blocks, const BlockWork& work) const;

    /// Calls work, which adds to the worker's loss and lane sums, for all blocks; adds the gradient and returns the
    /// loss, each summed over fixed ranges of blocks in fixed order.
    double sumOverBlocks(std::size_t blocks, std::span<double> gradient, const BlockWork& work) const;

    MlpShape shape_;
    InstructionSet set_;
    const TrainingKernel* kernel_;
    std::unique_ptr<Workspace> workspace_;
};

/// Adds decay times the sum of squares of all weights (not of the biases) to the gradient; returns that term of the
/// loss.
double addWeightDecay(const MlpShape& shape, std::span<const float> parameters, double decay,
                      std::span<double> gradient);

}  // namespace mrose
