#pragma once

#include <string>

namespace mrose {

/// A scenario of two robots, "one's" and "two", and a ball, which trials vary.
std::string gameText();

}  // namespace mrose
