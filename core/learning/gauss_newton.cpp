#include "learning/gauss_newton.h"

#include <algorithm>
#include <cassert>

#include "learning/kernel_choice.h"
#include "learning/parallel_for.h"

namespace mrose {

namespace {

constexpr int kBlock = static_cast<int>(PatternMatrix::kBlock);
constexpr int kRowsAtOnce = 64;

struct FeatureLayout {
    int size;            ///< h and 1, then slopes times inputs and 1
    std::size_t stride;  ///< size rounded up
    explicit FeatureLayout(const MlpShape& shape)
        : size(shape.hidden * (shape.inputs + 2) + 1), stride((static_cast<std::size_t>(size) + 63) / 64 * 64) {}
};

/// A sum over blocks, kept in float: its upper triangle.
using FloatGram = AlignedFloats;

class GramSum {
public:
    GramSum(const MlpShape& shape, std::span<const float> parameters, const PatternMatrix& inputs,
            const TrainingKernel& kernel)
        : shape_(shape), layout_(shape), parameters_(parameters), inputs_(inputs), kernel_(kernel) {}

    FloatGram over(const std::vector<std::size_t>& blocks, std::size_t begin, std::size_t end) const {
        FloatGram gram(layout_.size * layout_.stride);
        AlignedFloats h(static_cast<std::size_t>(shape_.hidden) * kBlock);
        AlignedFloats y(static_cast<std::size_t>(shape_.outputs) * kBlock);
        AlignedFloats features(kRowsAtOnce * layout_.stride);
        for (std::size_t i = begin; i < end; ++i) {
            const int patterns = static_cast<int>(inputs_.patternsOfBlock(blocks[i]));
            for (int first = 0; first < patterns; first += kRowsAtOnce) {
                const KernelTile t = tile(blocks[i], first, std::min(patterns - first, kRowsAtOnce));
                kernel_.forward(t, h.data(), y.data());
                kernel_.features(t, h.data(), features.data(), layout_.stride);
                kernel_.gram(features.data(), t.valid, layout_.size, layout_.stride, gram.data());
            }
        }
        return gram;
    }

private:
    KernelTile tile(std::size_t block, int first, int count) const {
        KernelTile t;
        t.inputs = shape_.inputs;
        t.hidden = shape_.hidden;
        t.outputs = shape_.outputs;
        t.valid = count;
        t.columns = (count + 15) / 16 * 16;
        t.parameters = parameters_.data();
        t.x = inputs_.block(block) + first;
        t.stride = t.hiddenStride = kBlock;
        return t;
    }

    MlpShape shape_;
    FeatureLayout layout_;
    std::span<const float> parameters_;
    const PatternMatrix& inputs_;
    const TrainingKernel& kernel_;
};

/// Expands the Gram matrix of the features to the matrix of all parameters.
class Expansion {
public:
    Expansion(const MlpShape& shape, std::span<const float> parameters, std::vector<double> gram)
        : shape_(shape), gram_(std::move(gram)), stride_(FeatureLayout(shape).stride) {
        outputWeights_ = parameters.data() + static_cast<std::size_t>(shape.hidden) * (shape.inputs + 1);
    }

    std::vector<double> matrix() {
        count_ = shape_.parameterCount();
        matrix_.assign(count_ * count_, 0.0);
        for (int q = 0; q < shape_.hidden * (shape_.inputs + 1); ++q) hiddenRow(q);
        for (int k = 0; k < shape_.outputs; ++k) outputBlock(k);
        return std::move(matrix_);
    }

private:
    double gram(int m, int n) const { return m < n ? gram_[m * stride_ + n] : gram_[n * stride_ + m]; }
    float v(int k, int j) const { return outputWeights_[k * shape_.hidden + j]; }

    /// The parameter that belongs to slope feature q = input * hidden + unit; the input after the last is the bias.
    std::size_t hiddenParameter(int q) const {
        assert(shape_.hidden > 0);
        const int i = q / shape_.hidden, j = q % shape_.hidden;
        return i < shape_.inputs ? static_cast<std::size_t>(j) * shape_.inputs + i
                                 : static_cast<std::size_t>(shape_.hidden) * shape_.inputs + j;
    }
    /// The parameter that belongs to output k and feature m = unit, or `hidden` for the bias.
    std::size_t outputParameter(int k, int m) const {
        return m < shape_.hidden ? static_cast<std::size_t>(shape_.hidden) * (shape_.inputs + 1 + k) + m
                                 : count_ - shape_.outputs + k;
    }

    void put(std::size_t a, std::size_t b, double value) { matrix_[a * count_ + b] = matrix_[b * count_ + a] = value; }

    void hiddenRow(int q) {
        const int first = shape_.hidden + 1, j = q % shape_.hidden;
        for (int r = q; r < shape_.hidden * (shape_.inputs + 1); ++r) {
            double product = 0;
            for (int k = 0; k < shape_.outputs; ++k) product += double{v(k, j)} * v(k, r % shape_.hidden);
            put(hiddenParameter(q), hiddenParameter(r), product * gram(first + q, first + r));
        }
        for (int k = 0; k < shape_.outputs; ++k)
            for (int m = 0; m <= shape_.hidden; ++m)
                put(outputParameter(k, m), hiddenParameter(q), v(k, j) * gram(m, first + q));
    }

    void outputBlock(int k) {
        for (int m = 0; m <= shape_.hidden; ++m)
            for (int n = m; n <= shape_.hidden; ++n) put(outputParameter(k, m), outputParameter(k, n), gram(m, n));
    }

    MlpShape shape_;
    std::vector<double> gram_, matrix_;
    std::size_t stride_, count_ = 0;
    const float* outputWeights_;
};

}  // namespace

std::vector<double> gaussNewtonMatrix(const MlpShape& shape, std::span<const float> parameters,
                                      const PatternMatrix& inputs, const BlockSelection& selection,
                                      InstructionSet set) {
    assert(parameters.size() == shape.parameterCount() && inputs.features() == shape.inputs);
    assert(selection.every > 0 && selection.first < inputs.blocks());
    std::vector<std::size_t> blocks;
    std::size_t patterns = 0;
    for (std::size_t block = selection.first; block < inputs.blocks(); block += selection.every) {
        blocks.push_back(block);
        patterns += inputs.patternsOfBlock(block);
    }
    // a large matrix allows fewer partial sums in memory
    const std::size_t ranges = std::min<std::size_t>(blocks.size(), FeatureLayout(shape).size < 1024 ? 8 : 2);
    std::vector<FloatGram> partial(ranges);
    const GramSum sum(shape, parameters, inputs, trainingKernelFor(set));
    parallelFor(ranges, [&](std::size_t range) {
        partial[range] = sum.over(blocks, blocks.size() * range / ranges, blocks.size() * (range + 1) / ranges);
    });
    std::vector<double> gram(partial[0].size());
    const double scale = 2 / (static_cast<double>(patterns) * shape.outputs);
    for (const FloatGram& part : partial)
        for (std::size_t i = 0; i < gram.size(); ++i) gram[i] += scale * part[i];
    return Expansion(shape, parameters, std::move(gram)).matrix();
}

}  // namespace mrose
