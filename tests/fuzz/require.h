#pragma once

#include <cstdlib>
#include <string>

#include "io/error.h"

namespace mrose {

/// What does not hold ends a fuzz target, whatever the build.
inline void require(bool condition) {
    if (!condition) std::abort();
}

inline void requireOneLine(const Error& error) {
    require(!error.cause.empty() && error.message().find('\n') == std::string::npos);
}

}  // namespace mrose
