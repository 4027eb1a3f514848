#pragma once

#include <cstdint>
#include <string>

#include "io/error.h"
#include "scenario/description_texts.h"

namespace mrose {

/// The same descriptions with `network` as the motion of one robot or person of the scenario: the key is set in the
/// scenario's text, of which all else stays. `network` is how the scenario names the file: absolute, or seen from the
/// scenario's folder; `content` is its text, which replaces what was kept under that name. Whether the network suits
/// the robot is told by loading the result (KeptDescriptions). Error: no such robot; the text has a syntax error.
Expected<Descriptions> withNetwork(const Descriptions& descriptions, const std::string& robot,
                                   const std::string& network, const std::string& content);

/// The same with another seed. Error: it is none that TOML can tell; the text has a syntax error.
Expected<Descriptions> withSeed(const Descriptions& descriptions, std::uint64_t seed);

}  // namespace mrose
