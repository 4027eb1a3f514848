#pragma once

#include <span>
#include <vector>

#include "physics/island_solver.h"

namespace mrose {

/// One tick of contacts, cluster by cluster; README.md says how. All that it knows of the tick before is passed to
/// solve(): what is kept from call to call is memory, and never matters to the result.
class ContactSolver {
public:
    /// `before` are the impulses of the tick before, in order of their keys; those for the next tick are appended to
    /// `after`, in no order. outcomes[i] is of cluster.bodies[i].
    void solve(const ContactTick& tick, const ContactCluster& cluster, std::span<const ContactImpulse> before,
               std::vector<ContactImpulse>& after, std::span<ContactOutcome> outcomes,
               std::vector<ContactReport>* reports = nullptr);

private:
    void goThroughTick();

    ClusterInTick cluster_;
    IslandSolver islandSolver_;
    std::vector<std::uint32_t> starting_;  ///< islands in which something touches when the tick begins
    std::vector<Meeting*> changed_;
};

}  // namespace mrose
