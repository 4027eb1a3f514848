#pragma once

#include <cstddef>

namespace mrose {

// What one robot can tell others at one instant.
constexpr std::size_t mostMessageBytes = 128;  ///< of one message
constexpr std::size_t mostMessages = 64;

}  // namespace mrose
