#pragma once

#include <string>
#include <vector>

#include "io/error.h"

namespace mrose {

/// That an output is none of the files that are read for it.
Expected<void> checkNotRead(const std::string& output, const std::vector<std::string>& inputs);
/// The same, and that it can be written: is not there, or `overwrite`.
Expected<void> checkOutput(const std::string& output, const std::vector<std::string>& inputs, bool overwrite);

}  // namespace mrose
