#include "learning/instruction_set.h"

#include <cstdlib>
#include <cstring>

namespace mrose {

namespace {

constexpr InstructionSet allInstructionSets[] = {InstructionSet::baseline, InstructionSet::avx2,
                                                 InstructionSet::avx512};

InstructionSet widestAllowed() {
    const char* const named = std::getenv("MROSE_INSTRUCTION_SET");
    for (const InstructionSet set : allInstructionSets)
        if (named != nullptr && std::strcmp(named, name(set)) == 0) return set;
    return InstructionSet::avx512;
}

}  // namespace

const char* name(InstructionSet set) {
    switch (set) {
        case InstructionSet::avx512:
            return "avx512";
        case InstructionSet::avx2:
            return "avx2";
        case InstructionSet::baseline:
            break;
    }
    return "baseline";
}

bool available(InstructionSet set) {
    static const InstructionSet allowed = widestAllowed();
    if (set > allowed) return false;
#if MROSE_X86_KERNELS
    if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2");
    if (set == InstructionSet::avx512) {
        return available(InstructionSet::avx2) && __builtin_cpu_supports("avx512f") &&
               __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
    }
#endif
    return set == InstructionSet::baseline;
}

InstructionSet bestInstructionSet() { return availableInstructionSets().back(); }

std::vector<InstructionSet> availableInstructionSets() {
    std::vector<InstructionSet> sets;
    for (const InstructionSet set : allInstructionSets)
        if (available(set)) sets.push_back(set);
    return sets;
}

}  // namespace mrose
