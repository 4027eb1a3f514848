#pragma once

#include "learning/inference_kernel.h"
#include "learning/instruction_set.h"
#include "learning/training_kernel.h"

namespace mrose {

/// The kernels for a set, which must be available.
const InferenceKernel& inferenceKernelFor(InstructionSet set);
const TrainingKernel& trainingKernelFor(InstructionSet set);

}  // namespace mrose
