#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common.h"
#include "comparison/compared_divergences.h"

namespace mrose::cli {

/// Flags about where simulated robots leave the real course, and why.
struct DivergenceFlags {
    std::optional<double> position, heading;  ///< m, degrees; neither: what the networks' held-out errors make likely
    double held = 0.3;                        ///< s
    bool noCauses = false;
    std::vector<std::string> models;
};
void addDivergenceFlags(CLI::App& sub, DivergenceFlags& flags);

/// Where the courses of a comparison diverge and why, with progress. Error: as of divergencesOf(), or interrupted.
Expected<ComparedDivergences> findDivergences(const LogWorld& world, const Comparison& comparison,
                                              const DivergenceFlags& flags, bool quiet);

/// For people.
void printDivergences(const Comparison& comparison, const ComparedDivergences& divergences);

}  // namespace mrose::cli
