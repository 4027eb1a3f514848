#pragma once

#include <span>

#include "physics/meeting.h"

namespace mrose {

/// What evenly moving contact points let sink in within a tick is pressed out at its end, where it is deeper than the
/// eye or the next tick would mind; velocities stay. Bodies are displaced by their masses, as by impulses.
void pressOut(std::span<MovingBody> bodies, std::span<Meeting> meetings, double time);

}  // namespace mrose
