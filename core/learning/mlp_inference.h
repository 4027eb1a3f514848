#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "learning/aligned_floats.h"
#include "learning/inference_kernel.h"
#include "learning/instruction_set.h"
#include "learning/mlp.h"

namespace mrose {

/// A network made ready for fast evaluation; const, so that threads may share it. A row's outputs have the same bits
/// alone, at any place of any batch and on every instruction set.
class MlpInference {
public:
    /// `set` must be available.
    explicit MlpInference(const Mlp& net, InstructionSet set = bestInstructionSet());

    const MlpShape& shape() const { return shape_; }

    /// x: `inputs` floats, y: `outputs` floats. They may not overlap.
    void one(const float* x, float* y) const;

    /// rows: n x inputs, out: n x outputs, both by rows. They may not overlap.
    void batch(const float* rows, float* out, std::size_t n) const;

private:
    PackedMlp packed() const;
    void oneByOne(const float* rows, float* out, std::size_t n) const;

    MlpShape shape_;
    const InferenceKernel* kernel_;
    AlignedFloats storage_;
};

}  // namespace mrose
