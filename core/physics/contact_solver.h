#pragma once

#include <span>
#include <vector>

#include "physics/energy.h"
#include "physics/exact_impulses.h"
#include "physics/impulse_sweeps.h"
#include "physics/meeting.h"

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
    void startTouching(std::span<const ContactImpulse> before);
    bool comesToPress(const Meeting& meeting) const;
    void goThroughTick();
    void join(const Meeting& meeting);
    void touchAt(double time, std::uint32_t island, Meeting* arriving);
    void addPair(Meeting& meeting, double time, const Meeting* arriving);
    bool addSpots(Meeting& meeting, double left, bool mayBounce, PressedPair& pair) const;
    void findImpulses();
    void collectSolution(double time, const Meeting* arriving);
    void lookAhead(Meeting& meeting, double time);
    bool mayBounce(const Meeting& meeting, const Meeting* arriving) const;
    double partingAt(const Meeting& meeting, const Point& where, const Point& axis) const;
    bool parting(const Meeting& meeting) const;
    ContactOutcome outcomeOf(MovingBody& body) const;
    void report(const Meeting& meeting, std::vector<ContactReport>& reports) const;

    MovingPiece pieceA(const Meeting& m) const { return {&bodies_[m.a], m.outlineA}; }
    MovingPiece pieceB(const Meeting& m) const { return {m.grounded() ? nullptr : &bodies_[m.b], m.outlineB}; }
    std::uint32_t islandOf(std::uint32_t body);

    const ContactTick* tick_ = nullptr;
    const ContactCluster* cluster_ = nullptr;
    std::vector<MovingBody> bodies_;
    std::vector<Meeting> meetings_;
    std::vector<std::uint32_t> island_;   ///< of each body: those that touched in this tick are one, named by its first
    std::vector<std::uint8_t> touching_;  ///< by island, once the start has been looked at: has a pair that touches
    std::vector<std::size_t> effort_;     ///< by island: pairs that have been solved for after the tick's start

    // Of the island that is being solved.
    ExactImpulses exact_;
    ImpulseSweeps sweeps_;
    std::vector<std::uint32_t> members_, place_;  ///< bodies; where each is among them
    std::vector<RigidBody> rigid_, rigidBefore_;  ///< of the members, then of the ground
    std::vector<PressedPair> pairs_;
    std::vector<Meeting*> pairOf_;
    std::vector<bool> bounces_;
};

}  // namespace mrose
