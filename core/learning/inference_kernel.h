#pragma once

#include <stddef.h>

namespace mrose {

/// A network laid out for the inference kernels. Padding holds zeros.
struct PackedMlp {
    int inputs = 0, hidden = 0, outputs = 0;
    int hiddenStride = 0;                  ///< hidden rounded up to 16
    int outputStride = 0;                  ///< outputs rounded up to 8
    const float* hiddenWeights = nullptr;  ///< [inputs][hiddenStride]
    const float* hiddenBiases = nullptr;   ///< [hiddenStride]
    const float* outputWeights = nullptr;  ///< [hidden][outputStride]
    const float* outputBiases = nullptr;   ///< [outputStride]
};

/// Scratch floats that a call may use: `one` hiddenStride + outputStride, `batch` 64 inputs + 16 (hidden +
/// outputs).
struct InferenceKernel {
    void (*one)(const PackedMlp&, const float* x, float* y, float* scratch);
    void (*batch)(const PackedMlp&, const float* rows, float* out, size_t n, float* scratch);
};

extern const InferenceKernel inferenceBaseline, inferenceAvx2, inferenceAvx512;

}  // namespace mrose
