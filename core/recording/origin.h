#pragma once

#include <string>
#include <vector>

#include "simulation/step.h"

namespace mrose {

/// What computed a run. The same step gives the same scenario and seed the same bits, on every x86-64 processor;
/// another build of it may not, but mostly does.
struct Origin {
    std::string version;     ///< of mrose
    std::string commit;      ///< of its source, "+" behind it where that was changed; "unknown"
    std::string compiler;    ///< "GNU 12.2.0"
    std::string buildType;   ///< "Release"
    int step = stepVersion;  ///< 1 where a recording does not say
    bool operator==(const Origin&) const = default;
};

/// Of the running program.
Origin thisOrigin();

/// How another origin differs from this one, a sentence each: "it was recorded by mrose 0.1.0; this is 0.2.0".
std::vector<std::string> differences(const Origin& recorded, const Origin& here);

}  // namespace mrose
