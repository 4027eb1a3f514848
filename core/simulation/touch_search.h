#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/shape.h"
#include "scene/obstacle_index.h"
#include "scene/point_grid.h"
#include "world/world_state.h"

namespace mrose {

/// A body within a tick: where it is, where it goes if nothing touches it, and how far any point of it gets.
struct SweptBody {
    const Shape* shape = nullptr;
    Pose pose, planned;
    double travel = 0;  ///< m

    static SweptBody of(const Shape& shape, const Pose& pose, const Pose& planned);
};

/// Which bodies may touch within a tick: all of them that do, few that do not. Memory is kept from call to call; the
/// result does not depend on it.
class TouchSearch {
public:
    /// Two bodies, or a body and an obstacle's piece, that are nearer than what they may move.
    struct Pair {
        std::uint32_t a = 0, b = 0;
        bool meet = true;  ///< false: they stay apart, if nothing else turns them from where they are planned to go
        bool operator==(const Pair&) const = default;
    };

    /// Pairs of bodies (a < b) and of a body and an obstacle's piece, both in ascending order. Those that pressed on
    /// each other when the last tick ended are taken for meeting without a look.
    void find(std::span<const SweptBody> bodies, const ObstacleIndex& obstacles,
              std::span<const ContactImpulse> pressed = {});
    /// Adds the pairs of those bodies whose travel has grown since. A body of each pair that is new.
    std::vector<std::uint32_t> widen(std::span<const SweptBody> bodies, std::span<const std::uint32_t> grown,
                                     const ObstacleIndex& obstacles);
    /// A body's pieces where it begins, until the next search. It must be one of a pair.
    std::span<const ConvexPiece> piecesOf(const SweptBody& body, std::uint32_t index) {
        return before_.of(body, index);
    }
    const std::vector<Pair>& bodyPairs() const { return bodyPairs_; }
    const std::vector<Pair>& obstaclePairs() const { return obstaclePairs_; }

    /// Distance at which the contact solver sees a touch, and a little more: m.
    static constexpr double margin = 2e-4;
    /// Nearer than this it takes them for touching.
    static constexpr double touching = 1e-4;

private:
    /// One that a body does not leave.
    struct Circle {
        Point centre;
        double radius = 0;

        static Circle of(const SweptBody& body) {
            return {position(body.pose), body.shape->reach + body.travel + margin / 2};
        }
        bool meets(const Circle& other) const {
            const double reach = radius + other.radius;
            const Point between = other.centre - centre;
            return dot(between, between) <= reach * reach;
        }
    };
    double widest() const;  ///< radius
    void findNear(std::span<const SweptBody> bodies);
    std::span<const std::uint32_t> obstaclesNear(std::uint32_t body, const ObstacleIndex& obstacles) const {
        return obstacles.near(circles_[body].centre, circles_[body].radius + margin / 2);
    }
    void findNearInGrid(std::span<const SweptBody> bodies);
    void consider(std::span<const SweptBody> bodies, std::uint32_t a, std::uint32_t b);
    void considerNear(const SweptBody& first, std::uint32_t a, const SweptBody& second, std::uint32_t b);
    void considerObstacle(const SweptBody& body, std::uint32_t index, std::uint32_t piece,
                          const ObstacleIndex& obstacles);
    /// Bodies' pieces at one end of the tick, placed when first asked for. They move in memory when others are.
    struct PlacedPieces {
        Pose SweptBody::*end;
        std::vector<ConvexPiece> pieces = {};
        std::vector<std::uint32_t> from = {};  ///< by body; notPlaced

        void forget(std::size_t bodies);
        std::span<const ConvexPiece> of(const SweptBody& body, std::uint32_t index);
    };
    /// Those of two bodies.
    static std::pair<std::span<const ConvexPiece>, std::span<const ConvexPiece>> both(
        PlacedPieces& placed, const SweptBody& first, std::uint32_t a, const SweptBody& second, std::uint32_t b);

    /// Pairs that pressed, in ascending order; by body, whether it is in one.
    void remember(std::span<const ContactImpulse> pressed, std::size_t bodies);
    bool pressedBodies(std::uint32_t a, std::uint32_t b) const;
    bool pressedObstacle(std::uint32_t body, std::uint32_t piece) const;
    using Key = std::pair<std::uint32_t, std::uint32_t>;
    std::vector<Key> pressedBodies_, pressedObstacles_;
    std::vector<bool> leans_;

    std::vector<Pair> bodyPairs_, obstaclePairs_;
    std::vector<Circle> circles_;  ///< by body
    std::vector<Point> centres_;   ///< theirs, where the grid is of them
    PointGrid grid_;
    PlacedPieces before_{&SweptBody::pose}, after_{&SweptBody::planned};
};

}  // namespace mrose
