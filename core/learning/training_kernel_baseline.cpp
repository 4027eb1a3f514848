#include "learning/training_kernel_body.h"

namespace mrose {

const TrainingKernel trainingBaseline = trainingKernel<4>();

}  // namespace mrose
