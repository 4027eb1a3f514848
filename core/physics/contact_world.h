#pragma once

#include <span>
#include <vector>

#include <box2d/box2d.h>

#include "physics/contact_plan.h"

namespace mrose {

/// A Box2D world for one tick of some clusters; then it is emptied and may serve others. That saves half of what small
/// worlds cost, and what comes out is the same, to the bit, as from a new world: of what Box2D 2.4.1 keeps, only the
/// length of the last step and the order of the broad phase's free nodes matter. The former is restored by fill(), and
/// the latter by empty(): where proxies go in the reverse order of their coming, the next ones get the same numbers.
class ContactWorld final : b2ContactFilter, b2ContactListener {
public:
    ContactWorld();

    /// outcomes[i] is of task.bodies[i], for the bodies of these clusters, and what the touching pairs pressed is
    /// appended to `impulses`.
    void solve(const ContactTask& task, std::span<const ContactImpulse> before,
               std::span<const ContactCluster> clusters, std::span<ContactOutcome> outcomes,
               std::vector<ContactImpulse>& impulses, std::vector<ContactReport>* reports);

private:
    void fill();
    void run();
    void takeBackEnergy(const ContactCluster& cluster);
    void collect(std::vector<ContactImpulse>& impulses);
    void empty();

    struct Body {
        b2Body* body;
        b2Vec2 velocity, planned;
        float rotation, plannedAngle;
        const ContactCluster* cluster;
    };
    /// An obstacle's piece, for all clusters of one origin.
    struct Ground {
        std::uint32_t piece;
        Point origin;
    };
    /// What a fixture's user data says: an index of the task's bodies or, beyond, of `ground_`, and the piece.
    struct Tag {
        std::uint32_t index, piece;
    };
    static std::uintptr_t pack(Tag tag) { return static_cast<std::uintptr_t>(tag.index) << 32 | tag.piece; }
    static Tag tagOf(b2Fixture* fixture);

    void addBody(std::size_t index, const ContactCluster& cluster);
    void addObstacle(const ContactObstacle& obstacle, const Point& origin);
    ContactOutcome outcomeOf(const Body& entry, const ContactBody& body) const;
    void report(b2Contact& contact, double impulse);

    std::uint32_t bodyOf(std::uint32_t index) const;
    ContactImpulse keyOf(b2Contact& contact) const;
    void vary(b2Contact& contact, const ContactImpulse& pair) const;

    bool ShouldCollide(b2Fixture* a, b2Fixture* b) override;
    void PreSolve(b2Contact* contact, const b2Manifold* old) override;
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;

    b2World world_;
    float lastStep_ = 0;  ///< s; of this length the world thinks its last step was
    const ContactTask* task_ = nullptr;
    std::span<const ContactImpulse> before_;
    std::vector<ContactReport>* reports_ = nullptr;            ///< null: they are not wanted
    std::vector<std::pair<b2Fixture*, b2Fixture*>> reported_;  ///< whom the newest of them are about
    std::span<const ContactCluster> clusters_;
    std::size_t first_ = 0;  ///< of the task's bodies
    std::vector<PlannedMove> moves_;
    std::vector<Body> bodies_;
    std::vector<Ground> ground_;
    b2Body* groundBody_ = nullptr;
    SolverEffort effort_;
    bool warm_ = true;  ///< in the first step only
};

}  // namespace mrose
