#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "geometry/pose.h"
#include "physics/collision_shape.h"
#include "world/world_state.h"

namespace mrose {

/// A body that may touch something in this tick. Without touch it goes from `pose` to `planned`.
struct ContactBody {
    std::uint32_t body = 0;     ///< its number in the world
    std::uint32_t cluster = 0;  ///< bodies touch only others of their cluster
    const CollisionShape* shape = nullptr;
    double mass = 1;     ///< kg
    double inertia = 1;  ///< kg m2, about the centre of mass
    Point centre;        ///< of mass, in the body's frame
    double reach = 0;    ///< m, of its shape
    double friction = 0, restitution = 0;
    Pose pose, planned;
};

/// A piece of what stands still, near a cluster.
struct ContactObstacle {
    std::uint32_t piece = 0;  ///< in the shape that holds all obstacles' pieces
    std::uint32_t cluster = 0;
    double friction = 0, restitution = 0;
};

struct ContactTask {
    std::vector<ContactBody> bodies;         ///< ascending by cluster, then by body
    std::vector<ContactObstacle> obstacles;  ///< ascending by cluster, then by piece
    const CollisionShape* obstacleShape = nullptr;
    double duration = 0.02;   ///< s
    double randomFactor = 0;  ///< see Scene
    std::uint64_t seed = 0;   ///< of the noise that it scales
    std::int64_t tick = 0;
};

/// Where a body really ends; `moved` is false where no touch took it off its plan.
struct ContactOutcome {
    bool moved = false;
    Pose pose;
    Twist velocity_W;  ///< of the reference point, m/s, m/s, rad/s
};

/// One touching pair, for people and recordings; never part of the state.
struct ContactReport {
    std::uint32_t bodyA = 0, bodyB = 0;  ///< noBody for what stands still
    std::uint32_t obstacle = 0;          ///< piece of it, where bodyB is noBody
    Point position;                      ///< in the world
    Point normal;                        ///< from A to B, length 1
    double impulse = 0;                  ///< N s, along the normal
};

class ContactWorld;
struct ContactCluster;

/// One tick of contacts by Box2D. All that it knows of the tick before is passed to solve(): what is kept from call to
/// call is memory, and never matters to the result.
class ContactSolver {
public:
    ContactSolver();
    ~ContactSolver();
    ContactSolver(const ContactSolver&) = delete;
    ContactSolver& operator=(const ContactSolver&) = delete;

    /// `before` are the impulses of the tick before, in order of their keys, as `after` has them for the next.
    /// outcomes[i] is of task.bodies[i].
    void solve(const ContactTask& task, std::span<const ContactImpulse> before, std::vector<ContactImpulse>& after,
               std::vector<ContactOutcome>& outcomes, std::vector<ContactReport>* reports = nullptr);

private:
    std::unique_ptr<ContactWorld> world_;
    std::vector<ContactCluster> clusters_;
};

}  // namespace mrose
