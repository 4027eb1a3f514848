#include "learning/inference_kernel_body.h"

namespace mrose {
namespace {

/// Few rows leave most of sixteen lanes empty.
void predictRows(const PackedMlp& net, const float* rows, float* out, size_t n, float* scratch) {
    if (n <= 8)
        predictBatch<8, 5>(net, rows, out, n, scratch);
    else
        predictBatch<16, 5>(net, rows, out, n, scratch);
}

}  // namespace

const InferenceKernel inferenceAvx512 = {predictOne<8, 16, 8>, predictRows};

}  // namespace mrose
