#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "learning/aligned_floats.h"

namespace mrose {

/// A matrix of floats, patterns x features, in the layout of the training kernels: blocks of 256 patterns, within a
/// block feature by feature, so that the 256 values of one feature lie side by side. The last block is padded.
class PatternMatrix {
public:
    static constexpr std::size_t kBlock = 256;

    PatternMatrix() = default;
    PatternMatrix(std::size_t patterns, int features);  ///< zeros

    /// A new size. Of the values nothing is kept unless the size is the old one.
    void resize(std::size_t patterns, int features);

    /// From rows [patterns][features].
    static PatternMatrix fromRows(std::span<const float> rows, int features);

    /// To rows [patterns][features].
    std::vector<float> toRows() const;

    std::size_t patterns() const { return patterns_; }
    int features() const { return features_; }

    float& operator()(std::size_t pattern, int feature) { return values_[index(pattern, feature)]; }
    float operator()(std::size_t pattern, int feature) const { return values_[index(pattern, feature)]; }

    std::size_t blocks() const { return (patterns_ + kBlock - 1) / kBlock; }

    /// How many patterns of this block are real; the rest is padding.
    std::size_t patternsOfBlock(std::size_t block) const {
        return block + 1 < blocks() ? kBlock : patterns_ - block * kBlock;
    }

    /// The values [features][256] of a block.
    float* block(std::size_t block) { return values_.data() + block * kBlock * features_; }
    const float* block(std::size_t block) const { return values_.data() + block * kBlock * features_; }

    /// One feature of a block's patterns, without the padding.
    std::span<float> column(std::size_t block, int feature) {
        return {this->block(block) + feature * kBlock, patternsOfBlock(block)};
    }
    std::span<const float> column(std::size_t block, int feature) const {
        return {this->block(block) + feature * kBlock, patternsOfBlock(block)};
    }

private:
    std::size_t index(std::size_t pattern, int feature) const {
        return (pattern / kBlock * features_ + feature) * kBlock + pattern % kBlock;
    }

    std::size_t patterns_ = 0;
    int features_ = 0;
    AlignedFloats values_;
};

}  // namespace mrose
