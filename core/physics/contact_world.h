#pragma once

#include <span>
#include <vector>

#include <box2d/box2d.h>

#include "physics/contact_physics.h"

namespace mrose {

/// Bodies that may touch one another, and the obstacles near them, as ranges of a task.
struct ContactCluster {
    std::size_t firstBody = 0, lastBody = 0;
    std::size_t firstObstacle = 0, lastObstacle = 0;
    double lightest = 0, heaviest = 0;  ///< kg
    Point origin;                       ///< near the bodies, so that float coordinates are fine everywhere

    std::size_t members() const { return lastBody - firstBody + (lastObstacle > firstObstacle ? 1 : 0); }
};

/// Orders impulses by whom they are between.
bool keyLess(const ContactImpulse& a, const ContactImpulse& b);

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
        Point move;  ///< planned, of the centre of mass, m
        bool fast;   ///< might pass through others within the tick
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

    static Body planOf(const ContactBody& body, const ContactCluster& cluster);
    void chooseSteps();
    bool mayTunnel() const;
    bool tunnels(const ContactBody& body, const ContactCluster& cluster) const;
    bool touchedBefore(std::uint32_t body, std::uint32_t piece) const;
    bool squeezed(std::uint32_t body) const;
    void addBody(std::size_t index);
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
    std::vector<ContactReport>* reports_ = nullptr;            ///< nothing: nobody wants them
    std::vector<std::pair<b2Fixture*, b2Fixture*>> reported_;  ///< whom the newest of them are about
    std::span<const ContactCluster> clusters_;
    std::size_t first_ = 0;  ///< of the task's bodies
    std::vector<Body> bodies_;
    std::vector<Ground> ground_;
    b2Body* groundBody_ = nullptr;
    int steps_ = 1, iterations_ = 0;
    float stepLength_ = 0;
    bool warm_ = true;  ///< in the first step only
};

}  // namespace mrose
