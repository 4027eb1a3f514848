#include "learning/inference_kernel_body.h"

namespace mrose {

const InferenceKernel inferenceAvx512 = {predictOne<8, 16, 8>, predictBatch<16, 5>};

}  // namespace mrose
