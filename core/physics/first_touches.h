#pragma once

#include <span>
#include <vector>

#include "physics/cluster_in_tick.h"

namespace mrose {

// Slower than this bounces are dead, m/s.
constexpr double bounceThreshold = 0.05;

/// Marks the meetings that take part when the tick begins: those that touch then, and those that come to press on each
/// other within it without a bounce. `starting` are the islands that these make, in order.
void findFirstTouches(ClusterInTick& cluster, std::span<const ContactImpulse> before,
                      std::vector<std::uint32_t>& starting);

}  // namespace mrose
