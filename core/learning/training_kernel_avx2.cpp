#include "learning/training_kernel_body.h"

namespace mrose {

const TrainingKernel trainingAvx2 = trainingKernel<8>();

}  // namespace mrose
