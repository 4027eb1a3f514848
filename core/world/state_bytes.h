#pragma once

#include <string>
#include <string_view>

#include "io/error.h"
#include "world/world_state.h"

namespace mrose {

/// Appends a state as bytes, exact to the last bit: little-endian, a version and the sizes of all arrays, then tick,
/// seed and the arrays field by field, without padding.
void appendStateBytes(const WorldState& state, std::string& bytes);
std::string stateBytes(const WorldState& state);

/// The version that bytes of a state say they are of, now 3; 0 where they say none.
std::uint32_t stateVersion(std::string_view bytes);

/// The state that bytes hold. Whether it is one of a given scenario is not asked here. `name` is said in errors. Bytes
/// of versions 1 and 2 (first_state_version.h, second_state_version.h) can still be read. Error: another version, sizes
/// that do not add up to the bytes' number (found before anything is allocated), a flag that is neither 0 nor 1.
Expected<WorldState> parseState(std::string_view bytes, const std::string& name);

}  // namespace mrose
