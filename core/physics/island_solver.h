#pragma once

#include <span>
#include <vector>

#include "physics/cluster_in_tick.h"
#include "physics/exact_impulses.h"
#include "physics/impulse_sweeps.h"

namespace mrose {

/// One island at one instant: which pairs press or bounce there, by which impulses, and how its bodies move on. What is
/// kept from call to call is memory, and never matters to the result.
class IslandSolver {
public:
    /// When the tick begins: all that touches then.
    void solveAtStart(ClusterInTick& cluster, std::uint32_t island);
    /// Later: all that presses, and the pair that arrives, which may bounce. `changed` are the meetings of bodies that
    /// move otherwise now, and the arriving one.
    void solveAt(ClusterInTick& cluster, double time, std::uint32_t island, Meeting& arriving,
                 std::vector<Meeting*>& changed);

private:
    void gatherBodies(double time, std::uint32_t island);
    void addPair(Meeting& meeting, double time, const Meeting* arriving);
    bool choosePoints(Meeting& meeting, double left, bool mayBounce, PressedPair& pair) const;
    void solve();
    void findImpulses();
    void keepStart();
    void countImpulses();
    void moveBodies();
    bool moved(std::uint32_t body) const;

    ClusterInTick* cluster_ = nullptr;
    ExactImpulses exact_;
    ImpulseSweeps sweeps_;
    std::vector<std::uint32_t> members_, place_;  ///< bodies; where each of these is among them (of others: stale)
    std::vector<RigidBody> rigid_, rigidBefore_;  ///< of the members, then of the ground
    std::vector<PressedPair> pairs_;
    std::vector<Meeting*> pairOf_;
    std::vector<bool> bounces_;
};

}  // namespace mrose
