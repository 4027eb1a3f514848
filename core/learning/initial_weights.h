#pragma once

#include <cstdint>

#include "learning/mlp.h"
#include "learning/pattern_set.h"

namespace mrose {

/// A network to start training from, for standardised inputs and targets. Uniform in +-scale: hidden weights and biases
/// with hiddenScale / sqrt(inputs + 1), output weights with outputScale / sqrt(hidden); output biases 0. The same seed
/// gives the same bits on every machine (Philox 2x64-10, no standard distributions).
struct InitialWeights {
    std::uint64_t seed = 1;
    double hiddenScale = 1.5;
    double outputScale = 0.5;
};

Mlp randomMlp(MlpShape shape, const InitialWeights& options = {});

/// Makes a network's first units, one for each output, the linear map that fits standardised patterns best (least
/// squares), in the middle of tanh where it is nearly straight. What is learned then is what the map lacks. Nothing
/// changes where half of the units or more would be needed.
void startLinear(Mlp& net, const PatternSet& patterns);

}  // namespace mrose
