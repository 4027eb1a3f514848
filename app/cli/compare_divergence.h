#pragma once

#include <string>
#include <vector>

#include "common.h"
#include "comparison/compared_divergences.h"

namespace mrose::cli {

/// Flags about where simulated robots leave the real course, and why.
struct DivergenceFlags {
    double position = 0.1, heading = 10, held = 0.3;  ///< m, degrees, s
    bool heldOut = false, noCauses = false;
    std::vector<std::string> models;
};
void addDivergenceFlags(CLI::App& sub, DivergenceFlags& flags);

/// Where the courses of a comparison diverge and why, with progress. Error: as of divergencesOf(), or interrupted.
Expected<ComparedDivergences> findDivergences(const LogWorld& world, const Comparison& comparison,
                                              const DivergenceFlags& flags, bool quiet);

/// For people.
void printDivergences(const Comparison& comparison, const ComparedDivergences& divergences);

}  // namespace mrose::cli
