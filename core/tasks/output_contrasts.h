#pragma once

#include <span>
#include <vector>

#include "learning/learned_network.h"
#include "learning/mlp.h"

namespace mrose {

/// What a network learns of outputs between which is chosen: their mean, and how far each of them is from it, all
/// standardised. Learned as they are, what they have in common would count most, which says nothing of which is best.
class OutputContrasts {
public:
    /// `standardised`: [row][output], at least one row.
    OutputContrasts(std::span<const float> standardised, std::span<const NetworkVariable> outputs);

    std::size_t count() const { return outputs() + 1; }
    /// [row][count()] of [row][output].
    std::vector<float> of(std::span<const float> standardised) const;
    /// The network of the outputs themselves, of one that gives these.
    Mlp undone(const Mlp& network) const;

private:
    std::size_t outputs() const { return scales_.size(); }
    std::vector<double> differences(const float* row) const;

    std::vector<double> scales_;   ///< of the outputs
    std::vector<double> spreads_;  ///< of what is learned
};

}  // namespace mrose
