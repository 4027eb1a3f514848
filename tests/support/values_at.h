#pragma once

#include <vector>

#include "quantities/value_key.h"

namespace mrose {

/// All that the catalogue has at a moment: of the run, of each body, and of each pair of them.
std::vector<ValueKey> valuesAt(const Moment& moment);

}  // namespace mrose
