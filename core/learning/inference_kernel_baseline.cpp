#include "learning/inference_kernel_body.h"

namespace mrose {

const InferenceKernel inferenceBaseline = {predictOne<4, 4, 4>, predictBatch<4, 2>};

}  // namespace mrose
