#pragma once

#include <cstddef>
#include <vector>

namespace mrose {

struct MlpShape {
    int inputs = 0, hidden = 0, outputs = 0;
    bool operator==(const MlpShape&) const = default;

    /// hidden x inputs weights, hidden biases, outputs x hidden weights, outputs biases.
    std::size_t parameterCount() const {
        return static_cast<std::size_t>(hidden) * (inputs + 1) + static_cast<std::size_t>(outputs) * (hidden + 1);
    }
};

/// y = V tanh(W x + b) + c: one hidden layer, linear outputs. Inputs and outputs are standardised by the caller.
struct Mlp {
    MlpShape shape;
    std::vector<float>
        parameters;  ///< W by rows [hidden][inputs], b [hidden], V by rows [outputs][hidden], c [outputs]
    bool operator==(const Mlp&) const = default;
};

}  // namespace mrose
