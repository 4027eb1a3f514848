#pragma once

#include <string>

#include "diagnosis/compared_divergences.h"

namespace mrose {

/// Where the robots leave the real trajectory and why, as a part of the comparison's page.
std::string divergenceSection(const Comparison& comparison, const ComparedDivergences& divergences);

}  // namespace mrose
