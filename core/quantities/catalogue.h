#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "quantities/quantity.h"

namespace mrose {

/// The catalogue: all quantities, in the order in which people are shown them. Each name is there once of a run, once
/// of a pair, and once of each body.
std::span<const Quantity> quantities();

/// The one of that name, which must be there.
const Quantity& quantityNamed(std::string_view name, Quantity::Of of);

/// An entry in the memory of a part of a robot (part.h): Of::items, of the part Subject::other.
const Quantity& partQuantity();

/// Whether a body has a quantity that is no pair's.
bool hasQuantity(const Scene& scene, std::uint32_t body, const Quantity& quantity);

/// The names of all that a body alone has, with those of its parts.
std::vector<std::string> quantityNames(const Scenario& scenario, std::uint32_t body);
/// "a, b, c ...", those first that come nearest to what was written.
std::string nearestNames(std::string_view written, std::vector<std::string> names);

/// Bodies by name, robots first; noBody: none of them.
std::uint32_t bodyNamed(const Scene& scene, std::string_view name);
const std::string& nameOfBody(const Scene& scene, std::uint32_t body);

}  // namespace mrose
