#pragma once

#include <cmath>

#include <nlohmann/json.hpp>

#include "assessment/metrics.h"

namespace mrose {

// Figures as results.json has them: keys end in their unit, what is not defined is null.

nlohmann::ordered_json json(const Distribution& distribution);
nlohmann::ordered_json json(const Summary& summary);
inline nlohmann::json finiteOrNull(double value) { return std::isfinite(value) ? nlohmann::json(value) : nullptr; }

}  // namespace mrose
