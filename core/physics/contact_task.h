#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/pose.h"
#include "physics/collision_shape.h"
#include "world/world_state.h"

namespace mrose {

/// A body that may touch something in this tick. Without touch it goes from `pose` to `planned`.
struct ContactBody {
    std::uint32_t body = 0;  ///< its number in the world
    const CollisionShape* shape = nullptr;
    std::span<const ConvexPiece> pieces;  ///< of its shape, in the world, where it begins
    double mass = 1;                      ///< kg
    double inertia = 1;                   ///< kg m2, about the centre of mass
    Point centre;                         ///< of mass, in the body's frame
    double reach = 0;                     ///< m, of its shape
    double friction = 0, restitution = 0;
    Pose pose, planned;
};

/// Two bodies of a cluster that may touch, by their places in it.
struct BodyPair {
    std::uint32_t a = 0, b = 0;
};

/// A body of a cluster and a piece of what stands still.
struct ObstaclePair {
    std::uint32_t body = 0;
    std::uint32_t piece = 0;  ///< in the shape that holds all obstacles' pieces
    double friction = 0, restitution = 0;
};

/// Bodies that may touch one another, directly or through others, and nothing else.
struct ContactCluster {
    std::vector<ContactBody> bodies;
    std::vector<BodyPair> pairs;
    std::vector<ObstaclePair> obstacles;
    void clear() {
        bodies.clear();
        pairs.clear();
        obstacles.clear();
    }
};

/// What holds for all clusters of a tick.
struct ContactTick {
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
    Twist velocity_W;   ///< of the reference point, m/s, m/s, rad/s
    double travel = 0;  ///< m, that any point of it went, at most
};

/// One touching pair, for people and recordings; never part of the state.
struct ContactReport {
    std::uint32_t bodyA = 0, bodyB = 0;  ///< noBody for what stands still
    std::uint32_t obstacle = 0;          ///< piece of it, where bodyB is noBody
    Point position;                      ///< in the world
    Point normal;                        ///< from A to B, length 1
    double impulse = 0;                  ///< N s, along the normal, in the whole tick
};

}  // namespace mrose
