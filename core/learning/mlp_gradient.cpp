#include "learning/mlp_gradient.h"

#include <algorithm>
#include <cassert>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "learning/kernel_choice.h"

namespace mrose {

namespace {

constexpr int kBlock = static_cast<int>(PatternMatrix::kBlock);
constexpr int kLanes = 16;

/// Patterns that a pass takes at once: as many as leave the hidden activations in the nearest caches.
int columnsAtOnce(int hidden) { return hidden <= 40 ? kBlock : kBlock / 2; }

/// Blocks whose gradients are summed in float lanes before they are added in double. A function of the batch alone.
std::size_t blocksPerRange(std::size_t blocks) { return std::clamp<std::size_t>(blocks / 48, 1, 8); }

/// f(tile, first column) for the parts of a block that are taken at once.
template <class F>
void forTiles(const MlpShape& shape, std::span<const float> parameters, const PatternMatrix& inputs, std::size_t block,
              const F& f) {
    const int valid = static_cast<int>(inputs.patternsOfBlock(block)), step = columnsAtOnce(shape.hidden);
    KernelTile tile;
    tile.inputs = shape.inputs;
    tile.hidden = shape.hidden;
    tile.outputs = shape.outputs;
    tile.parameters = parameters.data();
    tile.stride = tile.hiddenStride = kBlock;
    for (int first = 0; first < valid; first += step) {
        tile.valid = std::min(valid - first, step);
        tile.columns = (tile.valid + kLanes - 1) / kLanes * kLanes;
        tile.x = inputs.block(block) + first;
        f(tile, first);
    }
}

}  // namespace

/// What one thread works with.
struct MlpGradient::Worker {
    explicit Worker(const MlpShape& shape)
        : h(static_cast<std::size_t>(shape.hidden) * kBlock),
          y(static_cast<std::size_t>(shape.outputs) * kBlock),
          lanes(shape.parameterCount() * kLanes) {}

    /// The error with zeros in its padding.
    const float* padded(const KernelTile& tile, const float* error) {
        if (tile.valid == tile.columns) return error;
        for (int k = 0; k < tile.outputs; ++k) {
            float* row = y.data() + static_cast<std::size_t>(k) * kBlock;
            std::copy_n(error + static_cast<std::size_t>(k) * kBlock, tile.valid, row);
            std::fill(row + tile.valid, row + tile.columns, 0.0f);
        }
        return y.data();
    }

    std::vector<float> h, y, lanes;
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
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) { work(workspace_->workers.local(), block); });
}

double MlpGradient::sumOverBlocks(std::size_t blocks, std::span<double> gradient, const BlockWork& work) const {
    const std::size_t step = blocksPerRange(blocks), ranges = (blocks + step - 1) / step, count = gradient.size();
    std::vector<double> losses(ranges), partial(ranges * count);
    tbb::parallel_for(std::size_t{0}, ranges, [&](std::size_t range) {
        Worker& worker = workspace_->workers.local();
        worker.loss = 0;
        for (std::size_t block = range * step; block < std::min(blocks, (range + 1) * step); ++block)
            work(worker, block);
        losses[range] = worker.loss;
        if (count > 0) kernel_->reduce(worker.lanes.data(), count, partial.data() + range * count);
    });
    double loss = 0;
    for (std::size_t range = 0; range < ranges; ++range) {
        loss += losses[range];
        for (std::size_t i = 0; i < count; ++i) gradient[i] += partial[range * count + i];
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
        forTiles(shape_, parameters, inputs, block, [&](const KernelTile& tile, int first) {
            float* h = worker.h.data();
            float* y = worker.y.data();
            kernel_->forward(tile, h, y);
            worker.loss += kernel_->squaredError(tile, y, targets.block(block) + first, y);
            if (!gradient.empty()) kernel_->backward(tile, h, y, h, worker.lanes.data(), nullptr);
        });
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
        forTiles(shape_, parameters, inputs, block, [&](const KernelTile& tile, int first) {
            float* h = hidden ? hidden->block(block) + first : worker.h.data();
            kernel_->forward(tile, h, outputs.block(block) + first);
        });
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
        forTiles(shape_, parameters, inputs, block, [&](const KernelTile& tile, int first) {
            float* d = worker.h.data();
            if (!hidden) kernel_->forward(tile, d, worker.y.data());
            const float* h = hidden ? hidden->block(block) + first : d;
            float* dx = inputGradient ? inputGradient->block(block) + first : nullptr;
            const float* error = worker.padded(tile, outputGradient.block(block) + first);
            kernel_->backward(tile, h, error, d, worker.lanes.data(), dx);
        });
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
