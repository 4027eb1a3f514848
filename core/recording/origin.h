#pragma once

#include <string>
#include <vector>

namespace mrose {

/// What computed a run: the same scenario and seed give the same bits where all of this is the same.
struct Origin {
    std::string version;    ///< of mrose
    std::string commit;     ///< of its source, "+" behind it where that was changed; "unknown"
    std::string compiler;   ///< "GNU 12.2.0"
    std::string buildType;  ///< "Release"
    std::string cLibrary;   ///< its sines differ between versions and by the processor's instruction sets
    std::string processor;
    std::string instructionSets;  ///< "sse4.1 avx avx2 fma"
    bool operator==(const Origin&) const = default;
};

/// Of the running program.
Origin thisOrigin();

/// How another origin differs from this one, a sentence each: "it was recorded by mrose 0.1.0; this is 0.2.0".
std::vector<std::string> differences(const Origin& recorded, const Origin& here);

}  // namespace mrose
