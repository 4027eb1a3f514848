#pragma once

#include "common.h"
#include "workflow/compare_log.h"

namespace mrose::cli {

/// Flags about where simulated robots leave the real trajectory, and why.
void addDivergenceFlags(CLI::App& sub, DivergenceRequest& flags);

/// For people.
void printDivergences(const Comparison& comparison, const ComparedDivergences& divergences);

}  // namespace mrose::cli
