#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "learning/instruction_set.h"
#include "learning/mlp.h"
#include "learning/pattern_matrix.h"

namespace mrose {

/// Which blocks of the patterns (PatternMatrix::kBlock each) a matrix is taken from: first, first + every, ...
struct BlockSelection {
    std::size_t first = 0, every = 1;
};

/// Gauss and Newton's approximation of the mean squared error's second derivatives, 2 / (patterns * outputs) J'J with
/// J = d(outputs)/d(parameters), over the selected blocks: [parameterCount][parameterCount], symmetric.
/// All outputs share the hidden layer, and so one Gram matrix of the features h and (1 - h^2) x, from which the whole
/// matrix follows exactly. Its size is hidden * (inputs + 2) + 1. Threads as in MlpGradient.
std::vector<double> gaussNewtonMatrix(const MlpShape& shape, std::span<const float> parameters,
                                      const PatternMatrix& inputs, const BlockSelection& selection = {},
                                      InstructionSet set = bestInstructionSet());

}  // namespace mrose
