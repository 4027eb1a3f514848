#include "learning/initial_weights.h"

#include <cmath>
#include <vector>

#include <Random123/philox.h>

namespace mrose {

namespace {

/// Uniform in the open interval (-1, 1).
double uniform(std::uint64_t seed, std::uint64_t index) {
    const r123::Philox2x64::ctr_type counter = {{index, 0}};
    const r123::Philox2x64::key_type key = {{seed}};
    const std::uint64_t bits = r123::Philox2x64()(counter, key)[0];
    return (static_cast<double>(bits >> 11) + 0.5) * 0x1p-52 - 1.0;
}

}  // namespace

Mlp randomMlp(MlpShape shape, const InitialWeights& options) {
    Mlp net{shape, std::vector<float>(shape.parameterCount())};
    const double hidden = options.hiddenScale / std::sqrt(shape.inputs + 1.0);
    const double output = options.outputScale / std::sqrt(static_cast<double>(shape.hidden));
    const std::size_t firstOutput = static_cast<std::size_t>(shape.hidden) * (shape.inputs + 1);
    for (std::size_t i = 0; i + shape.outputs < net.parameters.size(); ++i)
        net.parameters[i] = static_cast<float>((i < firstOutput ? hidden : output) * uniform(options.seed, i));
    return net;
}

}  // namespace mrose
