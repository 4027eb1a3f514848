#pragma once

#include <nlohmann/json.hpp>

#include "assessment/compare.h"

namespace mrose {

/// What the compared sensors reported, as results.json has it: of all robots and of each.
nlohmann::ordered_json streamsJson(const Comparison& comparison);

}  // namespace mrose
