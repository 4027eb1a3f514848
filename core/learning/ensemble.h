#pragma once

#include <span>
#include <vector>

#include "learning/mlp.h"

namespace mrose {

/// A member of an ensemble that is evaluated as one network: a block of its hidden layer, in the order of the members.
struct EnsembleMember {
    int hidden = 0;  ///< units of its block
    /// Of its own outputs. The first outputs of the network, as many as these, are the means of the members'; any
    /// further ones were fitted to all hidden units together.
    std::vector<float> outputBiases;
    bool operator==(const EnsembleMember&) const = default;
};

/// The mean of networks of equal inputs and outputs as one network of one hidden layer: theirs side by side, the output
/// weights divided by their number. At least one.
Mlp mergedMean(std::span<const Mlp> networks);

/// What is to be known of them, so that each is found again in their mean.
std::vector<EnsembleMember> membersOf(std::span<const Mlp> networks);

/// One of the members of an ensemble: its outputs are those that are means of the members'. To the bit what was merged
/// where the number of members is a power of two, otherwise within the rounding of a division.
Mlp memberOf(const Mlp& ensemble, std::span<const EnsembleMember> members, std::size_t index);

/// Whether an ensemble can be of these members: their blocks fill its hidden layer, and its output biases are the means
/// of theirs.
bool isMeanOf(const Mlp& ensemble, std::span<const EnsembleMember> members);

/// The ensemble with the outputs of its members behind its own, first all of the first member: one network of the same
/// hidden layer. The ensemble's own outputs stay what they were to the bit; a member's are to the bit those of
/// memberOf() evaluated by itself where its block begins at a multiple of 4 units, otherwise within rounding.
Mlp withMemberOutputs(const Mlp& ensemble, std::span<const EnsembleMember> members);

}  // namespace mrose
