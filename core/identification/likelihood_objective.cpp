#include "identification/likelihood_objective.h"

#include <array>
#include <cassert>

#include "learning/parallel_for.h"

namespace mrose {

double LikelihoodObjective::loss(Part part, PatternMatrix& outputs, bool withGradient) const {
    const LikelihoodData& of = data(part);
    const std::size_t width = of.outputs.size();
    assert(outputs.features() == static_cast<int>(width));
    std::vector<double> sums(outputs.blocks());
    const double share = 1 / static_cast<double>(outputs.patterns());
    parallelFor(outputs.blocks(), [&](std::size_t block) {
        std::array<double, LearnedNetwork::maxOutputs> values, gradient;
        const std::size_t begin = block * PatternMatrix::kBlock;
        for (std::size_t i = 0; i < outputs.patternsOfBlock(block); ++i) {
            const std::size_t pattern = begin + i;
            for (std::size_t k = 0; k < width; ++k)
                values[k] = of.outputs[k].mean +
                            of.outputs[k].scale * static_cast<double>(outputs(pattern, static_cast<int>(k)));
            sums[block] += of.loss(pattern, std::span(values).first(width), gradient.data());
            if (!withGradient) continue;
            for (std::size_t k = 0; k < width; ++k)
                outputs(pattern, static_cast<int>(k)) = static_cast<float>(gradient[k] * of.outputs[k].scale * share);
        }
    });
    double sum = 0;
    for (const double part_ : sums) sum += part_;
    return sum * share;
}

double LikelihoodObjective::lossAndGradient(std::span<const float> parameters, std::span<double> gradient) const {
    std::fill(gradient.begin(), gradient.end(), 0.0);
    forward(parameters, Part::learned, outputs_);
    const double mean = loss(Part::learned, outputs_, true);
    return mean + backward(parameters, outputs_, gradient);
}

double LikelihoodObjective::validationError(std::span<const float> parameters) {
    PatternMatrix outputs;
    forward(parameters, Part::heldOut, outputs);
    return loss(Part::heldOut, outputs, false);
}

NetworkLikelihood::NetworkLikelihood(const LikelihoodData& learned, const LikelihoodData& heldOut, int hidden)
    : LikelihoodObjective(learned, heldOut),
      engine_({learned.inputs.features(), hidden, static_cast<int>(learned.outputs.size())}) {}

void NetworkLikelihood::forward(std::span<const float> parameters, Part part, PatternMatrix& outputs) const {
    engine_.forward(parameters, data(part).inputs, outputs, part == Part::learned ? &hidden_ : nullptr);
}

double NetworkLikelihood::backward(std::span<const float> parameters, const PatternMatrix& outputGradient,
                                   std::span<double> gradient) const {
    engine_.backward(parameters, data(Part::learned).inputs, outputGradient, gradient, &hidden_);
    return 0;
}

TableLikelihood::TableLikelihood(const LikelihoodData& learned, const LikelihoodData& heldOut,
                                 const LookupTable& blueprint, double roughness)
    : LikelihoodObjective(learned, heldOut),
      blueprint_(blueprint),
      roughness_(roughness),
      learnedCells_(blueprint, learned.inputs),
      heldOutCells_(blueprint, heldOut.inputs) {}

void TableLikelihood::forward(std::span<const float> parameters, Part part, PatternMatrix& outputs) const {
    (part == Part::learned ? learnedCells_ : heldOutCells_).forward(parameters, outputs);
}

double TableLikelihood::backward(std::span<const float> parameters, const PatternMatrix& outputGradient,
                                 std::span<double> gradient) const {
    learnedCells_.backward(outputGradient, gradient);
    return addRoughness(blueprint_, parameters, roughness_, gradient);
}

}  // namespace mrose
