#pragma once

#include <string>

namespace mrose {

/// A word as a shell takes it for one.
std::string shellQuoted(const std::string& word);

}  // namespace mrose
