#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace mrose {

/// What a point of the unit cube costs; nullopt ends the search.
using PointCost = std::function<std::optional<double>(std::span<const double> point)>;

/// Asks for the costs of `start`, of points spread over the unit cube (a Latin hypercube, five for each dimension), and
/// of where Subplex (Rowan 1990, as NLopt has it) goes: from the cheapest of all, again from there with a smaller step,
/// then from anywhere. Goes on until `cost` ends it. Costs are compared and not computed with, so that
/// they may be rough where they are high. The same for the same seed and costs. `leastSteps`, by dimension: less is no
/// other point.
void searchUnitCube(const std::vector<double>& start, const std::vector<double>& leastSteps, std::uint64_t seed,
                    const PointCost& cost);

}  // namespace mrose
