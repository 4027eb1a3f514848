#pragma once

#include <vector>

namespace mrose {

/// Which build of a kernel runs. Every kernel is compiled for each, and chosen at run time; all give the same bits.
enum class InstructionSet {
    baseline,  ///< what every processor of the platform has (SSE2 on x86-64)
    avx2,      ///< AVX2
    avx512     ///< AVX-512 F, DQ, VL
};

const char* name(InstructionSet set);

/// Whether this processor, its system and this build have the set, and the environment variable MROSE_INSTRUCTION_SET
/// does not name a narrower one: with it, tests run the program as on an older processor.
bool available(InstructionSet set);

/// The widest available.
InstructionSet bestInstructionSet();

/// All available ones, the baseline first.
std::vector<InstructionSet> availableInstructionSets();

}  // namespace mrose
