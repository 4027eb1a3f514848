#pragma once

#include "physics/cluster_in_tick.h"

namespace mrose {

/// Where a body is when the tick ends.
ContactOutcome outcomeOf(MovingBody& body, double duration);

/// Whether a pair presses when the tick ends, and did so with an impulse, and does not go apart.
bool pressesOn(const ClusterInTick& cluster, const Meeting& meeting);

/// Whether people are told of it: a pair that touches when the tick ends, or was given an impulse in it.
bool worthReporting(const Meeting& meeting);
ContactReport reportOf(const ContactCluster& cluster, const Meeting& meeting);

}  // namespace mrose
