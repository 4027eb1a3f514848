#pragma once

#include <span>

#include "physics/impulses.h"

namespace mrose {

/// Where bodies both bounce and rub, Newton's restitution may leave them with more energy than they had (Kane and
/// Levinson 1985). Then what they move about their common motion, or about the ground where that is of it, is made
/// slower: what was separating still is. before[i] is bodies[i] as it was.
void takeBackEnergy(std::span<const RigidBody> before, std::span<RigidBody> bodies, bool grounded);

}  // namespace mrose
