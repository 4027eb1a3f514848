#pragma once

#include "common.h"
#include "workflow/divergence_request.h"

namespace mrose::cli {

/// Flags about where simulated robots leave the real trajectory, and why.
void addDivergenceFlags(CLI::App& sub, DivergenceRequest& flags);

/// Where the rollouts of a comparison diverge and why, with progress. Error: as of divergencesOf(), or interrupted.
Expected<ComparedDivergences> findDivergences(const LogWorld& world, const Comparison& comparison,
                                              const DivergenceRequest& flags, bool quiet);

/// For people.
void printDivergences(const Comparison& comparison, const ComparedDivergences& divergences);

}  // namespace mrose::cli
