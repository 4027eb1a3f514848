#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "learning/learned_network.h"
#include "learning/table_gradient.h"
#include "learning/trainer.h"

namespace mrose {

/// The loss of one pattern by the values that a mapping gives for it, in their units, and its gradient by them, which
/// is overwritten: minus the logarithm of the likelihood of what happened.
using PatternLoss = std::function<double(std::size_t pattern, std::span<const double> values, double* gradient)>;

/// Standardised inputs, what is lost on them, and which of them are held out.
struct LikelihoodData {
    PatternMatrix inputs;
    std::vector<NetworkVariable> outputs;  ///< how the outputs are standardised
    PatternLoss loss;
};

/// Maximum likelihood: the mean of the losses over patterns. Of a network or a table, whose values are the parameters.
class LikelihoodObjective : public TrainingObjective {
public:
    /// What is learned from and what is held out must outlive it; both have the same outputs.
    LikelihoodObjective(const LikelihoodData& learned, const LikelihoodData& heldOut)
        : learned_(learned), heldOut_(heldOut) {}

    double lossAndGradient(std::span<const float> parameters, std::span<double> gradient) const override;
    double validationError(std::span<const float> parameters) override;

protected:
    enum class Part { learned, heldOut };
    virtual void forward(std::span<const float> parameters, Part part, PatternMatrix& outputs) const = 0;
    /// Of what was learned from, with the outputs of forward(); adds to the gradient.
    virtual double backward(std::span<const float> parameters, const PatternMatrix& outputGradient,
                            std::span<double> gradient) const = 0;
    const LikelihoodData& data(Part part) const { return part == Part::learned ? learned_ : heldOut_; }

private:
    double loss(Part part, PatternMatrix& outputs, bool withGradient) const;

    const LikelihoodData &learned_, &heldOut_;
    mutable PatternMatrix outputs_;  ///< kept for their memory
};

class NetworkLikelihood final : public LikelihoodObjective {
public:
    NetworkLikelihood(const LikelihoodData& learned, const LikelihoodData& heldOut, int hidden);
    const MlpGradient* engine() const override { return &engine_; }

private:
    void forward(std::span<const float> parameters, Part part, PatternMatrix& outputs) const override;
    double backward(std::span<const float> parameters, const PatternMatrix& outputGradient,
                    std::span<double> gradient) const override;

    MlpGradient engine_;
    mutable PatternMatrix hidden_;
};

class TableLikelihood final : public LikelihoodObjective {
public:
    /// `roughness`: what neighbours cost that differ (addRoughness()).
    TableLikelihood(const LikelihoodData& learned, const LikelihoodData& heldOut, const LookupTable& blueprint,
                    double roughness);
    const MlpGradient* engine() const override { return nullptr; }
    std::size_t parameterCount() const override { return learnedCells_.parameterCount(); }

private:
    void forward(std::span<const float> parameters, Part part, PatternMatrix& outputs) const override;
    double backward(std::span<const float> parameters, const PatternMatrix& outputGradient,
                    std::span<double> gradient) const override;

    const LookupTable& blueprint_;
    double roughness_;
    TableGradient learnedCells_, heldOutCells_;
};

}  // namespace mrose
