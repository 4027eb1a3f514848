#include "learning/training_kernel_body.h"

namespace mrose {

const TrainingKernel trainingAvx512 = trainingKernel<16>();

}  // namespace mrose
