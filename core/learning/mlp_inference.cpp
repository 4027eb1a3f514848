#include "learning/mlp_inference.h"

#include <cassert>

#include "learning/kernel_choice.h"

namespace mrose {

namespace {

constexpr int kMostLanes = 16;
constexpr std::size_t kScratchOnStack = 8192;  // floats
constexpr std::size_t kFewRows = 4;            // quicker one by one than in lanes that are mostly empty

int roundUp(int count, int multiple) { return (count + multiple - 1) / multiple * multiple; }

/// Calls f with `floats` floats of scratch memory: on the stack, if they fit.
template <class F>
void withScratch(std::size_t floats, const F& f) {
    if (floats <= kScratchOnStack) {
        alignas(64) float scratch[kScratchOnStack];
        f(scratch);
    } else {
        std::vector<float> scratch(floats);
        f(scratch.data());
    }
}

}  // namespace

MlpInference::MlpInference(const Mlp& net, InstructionSet set) : shape_(net.shape), kernel_(&inferenceKernelFor(set)) {
    assert(available(set));
    assert(net.parameters.size() == shape_.parameterCount());
    const auto [inputs, hidden, outputs] = shape_;
    const int hiddenStride = roundUp(hidden, kMostLanes), outputStride = roundUp(outputs, 8);
    storage_.assign(hiddenStride * (inputs + 1) + outputStride * (hidden + 1), 0.0f);
    const float* from = net.parameters.data();
    float* to = storage_.data();
    for (int j = 0; j < hidden; ++j)
        for (int i = 0; i < inputs; ++i) to[i * hiddenStride + j] = *from++;
    to += hiddenStride * inputs;
    for (int j = 0; j < hidden; ++j) to[j] = *from++;
    to += hiddenStride;
    for (int k = 0; k < outputs; ++k)
        for (int j = 0; j < hidden; ++j) to[j * outputStride + k] = *from++;
    to += outputStride * hidden;
    for (int k = 0; k < outputs; ++k) to[k] = *from++;
}

PackedMlp MlpInference::packed() const {
    PackedMlp net;
    net.inputs = shape_.inputs;
    net.hidden = shape_.hidden;
    net.outputs = shape_.outputs;
    net.hiddenStride = roundUp(shape_.hidden, kMostLanes);
    net.outputStride = roundUp(shape_.outputs, 8);
    net.hiddenWeights = storage_.data();
    net.hiddenBiases = net.hiddenWeights + net.inputs * net.hiddenStride;
    net.outputWeights = net.hiddenBiases + net.hiddenStride;
    net.outputBiases = net.outputWeights + net.hidden * net.outputStride;
    return net;
}

void MlpInference::one(const float* x, float* y) const { oneByOne(x, y, 1); }

void MlpInference::oneByOne(const float* rows, float* out, std::size_t n) const {
    const PackedMlp net = packed();
    withScratch(net.hiddenStride + net.outputStride, [&](float* scratch) {
        for (std::size_t i = 0; i < n; ++i, rows += net.inputs, out += net.outputs)
            kernel_->one(net, rows, out, scratch);
    });
}

void MlpInference::batch(const float* rows, float* out, std::size_t n) const {
    if (n <= kFewRows) return oneByOne(rows, out, n);
    const PackedMlp net = packed();
    const std::size_t floats = 64 * net.inputs + kMostLanes * (net.hidden + net.outputs);
    withScratch(floats, [&](float* scratch) { kernel_->batch(net, rows, out, n, scratch); });
}

}  // namespace mrose
