#include "learning/inference_kernel_body.h"

namespace mrose {

const InferenceKernel inferenceAvx2 = {predictOne<8, 8, 8>, predictBatch<8, 2>};

}  // namespace mrose
