#include "learning/kernel_choice.h"

#include <cassert>

namespace mrose {

#if MROSE_X86_KERNELS

namespace {

template <class Kernel>
const Kernel& choose(InstructionSet set, const Kernel& baseline, const Kernel& avx2, const Kernel& avx512) {
    assert(available(set));
    if (set == InstructionSet::avx512) return avx512;
    if (set == InstructionSet::avx2) return avx2;
    return baseline;
}

}  // namespace

const InferenceKernel& inferenceKernelFor(InstructionSet set) {
    return choose(set, inferenceBaseline, inferenceAvx2, inferenceAvx512);
}

const TrainingKernel& trainingKernelFor(InstructionSet set) {
    return choose(set, trainingBaseline, trainingAvx2, trainingAvx512);
}

#else

const InferenceKernel& inferenceKernelFor(InstructionSet) { return inferenceBaseline; }

const TrainingKernel& trainingKernelFor(InstructionSet) { return trainingBaseline; }

#endif

}  // namespace mrose
