#pragma once

#include "physics/cluster_in_tick.h"

namespace mrose {

/// Sets when something happens to a meeting next, as its bodies move from `time` on: when a pair that is apart touches,
/// when one that presses has sunk in or turned so far that it has to be solved for again; never, if nothing does
/// before the tick ends.
void findNextEvent(ClusterInTick& cluster, Meeting& meeting, double time);

}  // namespace mrose
