#include "learning/mlp_gradient.h"

#include <algorithm>
#include <cassert>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include "learning/kernel_choice.h"
#include "learning/parallel_for.h"

namespace mrose {

namespace {

constexpr int kLanes = 16;

/// Blocks whose gradients are summed in float lanes before they are added in double. A function of the batch alone.
std::size_t blocksPerRange(std::size_t blocks) { return std::clamp<std::size_t>(blocks / 48, 1, 8); }

/// A block of patterns on its way through the network.
KernelTile tileOf(const MlpShape& shape, std::span<const float> parameters, const PatternMatrix& inputs,
                  std::size_t block) {
    KernelTile tile;
    tile.inputs = shape.inputs;
    tile.hidden = shape.hidden;
    tile.outputs = shape.outputs;
    tile.valid = static_cast<int>(inputs.patternsOfBlock(block));
    tile.columns = (tile.valid + kLanes - 1) / kLanes * kLanes;
    tile.parameters = parameters.data();
    tile.x = inputs.block(block);
    tile.stride = tile.hiddenStride = PatternMatrix::kBlock;
    return tile;
}

}  // namespace

/// What one thread works with.
struct MlpGradient::Worker {
    explicit Worker(const MlpShape& shape)
        : h(static_cast<std::size_t>(shape.hidden) * PatternMatrix::kBlock),
          y(static_cast<std::size_t>(shape.outputs) * PatternMatrix::kBlock),
          lanes(shape.parameterCount() * kLanes) {}

    /// The error with zeros in its padding.
    const float* padded(const KernelTile& tile, const float* error) {
        if (tile.valid == tile.columns) return error;
        for (int k = 0; k < tile.outputs; ++k) {
            float* row = y.data() + static_cast<std::size_t>(k) * PatternMatrix::kBlock;
            std::copy_n(error + static_cast<std::size_t>(k) * PatternMatrix::kBlock, tile.valid, row);
            std::fill(row + tile.valid, row + tile.columns, 0.0f);
        }
        return y.data();
    }

    AlignedFloats h, y, lanes;
    std::vector<double> partial;  ///< sums of all ranges of a call that this thread made
    double loss = 0;
};

struct MlpGradient::Workspace {
    explicit Workspace(const MlpShape& shape) : workers([shape] { return Worker(shape); }) {}
    tbb::enumerable_thread_specific<Worker> workers;
};

MlpGradient::MlpGradient(MlpShape shape, InstructionSet set)
    : shape_(shape), set_(set), kernel_(&trainingKernelFor(set)), workspace_(std::make_unique<Workspace>(shape)) {}
MlpGradient::~MlpGradient() = default;
MlpGradient::MlpGradient(MlpGradient&&) noexcept = default;
MlpGradient& MlpGradient::operator=(MlpGradient&&) noexcept = default;

void MlpGradient::forBlocks(std::size_t blocks, const BlockWork& work) const {
    parallelFor(blocks, [&](std::size_t block) { work(workspace_->workers.local(), block); });
}

double MlpGradient::sumOverBlocks(std::size_t blocks, std::span<double> gradient, const BlockWork& work) const {
    const std::size_t step = blocksPerRange(blocks), ranges = (blocks + step - 1) / step, count = gradient.size();
    // kept from call to call: fresh memory of this size costs more than a small batch
    std::vector<double>& partial = workspace_->workers.local().partial;
    partial.assign(ranges * (count + 1), 0.0);
    const auto sumRange = [&](std::size_t range) {
        Worker& worker = workspace_->workers.local();
        double* sums = partial.data() + range * (count + 1);
        worker.loss = 0;
        for (std::size_t block = range * step; block < std::min(blocks, (range + 1) * step); ++block)
            work(worker, block);
        sums[count] = worker.loss;
        if (count > 0) kernel_->reduce(worker.lanes.data(), count, sums);
    };
    // isolated: while it waits, this thread must not begin another task that uses its partial sums
    tbb::this_task_arena::isolate([&] { parallelFor(ranges, sumRange); });
    double loss = 0;
    for (std::size_t range = 0; range < ranges; ++range) {
        const double* sums = partial.data() + range * (count + 1);
        for (std::size_t i = 0; i < count; ++i) gradient[i] += sums[i];
        loss += sums[count];
    }
    return loss;
}

double MlpGradient::meanSquaredError(std::span<const float> parameters, const PatternMatrix& inputs,
                                     const PatternMatrix& targets) const {
    return meanSquaredError(parameters, inputs, targets, {});
}

double MlpGradient::meanSquaredError(std::span<const float> parameters, const PatternMatrix& inputs,
                                     const PatternMatrix& targets, std::span<double> gradient) const {
    assert(parameters.size() == shape_.parameterCount());
    assert(inputs.patterns() == targets.patterns());
    assert(inputs.features() == shape_.inputs && targets.features() == shape_.outputs);
    std::fill(gradient.begin(), gradient.end(), 0.0);
    const double sum = sumOverBlocks(inputs.blocks(), gradient, [&](Worker& worker, std::size_t block) {
        const KernelTile tile = tileOf(shape_, parameters, inputs, block);
        float* h = worker.h.data();
        float* y = worker.y.data();
        kernel_->forward(tile, h, y);
        worker.loss += kernel_->squaredError(tile, y, targets.block(block), y);
        if (!gradient.empty()) kernel_->backward(tile, h, y, h, worker.lanes.data(), nullptr);
    });
    const double count = static_cast<double>(inputs.patterns()) * shape_.outputs;
    for (double& g : gradient) g *= 2 / count;
    return sum / count;
}

void MlpGradient::forward(std::span<const float> parameters, const PatternMatrix& inputs, PatternMatrix& outputs,
                          PatternMatrix* hidden) const {
    assert(parameters.size() == shape_.parameterCount() && inputs.features() == shape_.inputs);
    outputs.resize(inputs.patterns(), shape_.outputs);
    if (hidden) hidden->resize(inputs.patterns(), shape_.hidden);
    forBlocks(inputs.blocks(), [&](Worker& worker, std::size_t block) {
        float* h = hidden ? hidden->block(block) : worker.h.data();
        kernel_->forward(tileOf(shape_, parameters, inputs, block), h, outputs.block(block));
    });
}

void MlpGradient::backward(std::span<const float> parameters, const PatternMatrix& inputs,
                           const PatternMatrix& outputGradient, std::span<double> gradient, const PatternMatrix* hidden,
                           PatternMatrix* inputGradient) const {
    assert(parameters.size() == shape_.parameterCount() && gradient.size() == shape_.parameterCount());
    assert(inputs.features() == shape_.inputs && outputGradient.features() == shape_.outputs);
    assert(inputs.patterns() == outputGradient.patterns());
    assert(!hidden || (hidden->patterns() == inputs.patterns() && hidden->features() == shape_.hidden));
    if (inputGradient) inputGradient->resize(inputs.patterns(), shape_.inputs);
    sumOverBlocks(inputs.blocks(), gradient, [&](Worker& worker, std::size_t block) {
        const KernelTile tile = tileOf(shape_, parameters, inputs, block);
        float* d = worker.h.data();
        if (!hidden) kernel_->forward(tile, d, worker.y.data());
        const float* h = hidden ? hidden->block(block) : d;
        const float* error = worker.padded(tile, outputGradient.block(block));
        kernel_->backward(tile, h, error, d, worker.lanes.data(),
                          inputGradient ? inputGradient->block(block) : nullptr);
    });
}

double addWeightDecay(const MlpShape& shape, std::span<const float> parameters, double decay,
                      std::span<double> gradient) {
    assert(parameters.size() == shape.parameterCount() && gradient.size() == parameters.size());
    const std::size_t biases = static_cast<std::size_t>(shape.hidden) * shape.inputs;
    const std::size_t firstAfter = biases + shape.hidden, last = parameters.size() - shape.outputs;
    double term = 0;
    for (std::size_t i = 0; i < last; ++i) {
        if (i >= biases && i < firstAfter) continue;
        gradient[i] += 2 * decay * parameters[i];
        term += decay * parameters[i] * parameters[i];
    }
    return term;
}

}  // namespace mrose
