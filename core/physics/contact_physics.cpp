#include "physics/contact_physics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include <box2d/box2d.h>

#include "physics/prepared_shape.h"
#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

// A world of more bodies than this is split: Box2D's island solver grows faster than linearly.
constexpr std::size_t bodiesPerWorld = 64;
// Box2D limits a step to 2 units and a quarter turn.
constexpr double longestMove = 1.5, largestTurn = 1.2;
constexpr int velocityIterations = 8, positionIterations = 3;
// A light body squeezed between heavy ones needs more: each iteration leaves heavy / (heavy + light) of the error.
constexpr int squeezedIterations = 40;
constexpr double light = 0.25;
// Below this speed (units/s) bounces are dead: 5 cm/s.
constexpr float bounceThreshold = 0.5F;
// A path that differs by less than this (units) is the planned one, rounded to float.
constexpr float onPlan = 3e-4F;
// A body that moves farther than this (m) in a step needs continuous collision with other moving ones too.
constexpr double farMove = 0.02;
// Continuous collision takes a quarter of a step's time. Bodies that only lean on what they touched before do without,
// and those that would come less deep (m) into something new, which the solver presses out again.
constexpr double shallow = 0.002;

using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;
Key keyOf(const ContactImpulse& c) { return {c.bodyA, c.pieceA, c.bodyB, c.pieceB, c.feature}; }

/// What a fixture's user data says: an index of `task.bodies`, or, from `bodies.size()` on, of `task.obstacles`, and
/// the piece.
struct Tag {
    std::uint32_t index, piece;
};
std::uintptr_t pack(Tag tag) { return static_cast<std::uintptr_t>(tag.index) << 32 | tag.piece; }
Tag tagOf(const b2Fixture* fixture) {
    const std::uintptr_t data = const_cast<b2Fixture*>(fixture)->GetUserData().pointer;
    return {static_cast<std::uint32_t>(data >> 32), static_cast<std::uint32_t>(data)};
}

float units(double metres) { return static_cast<float>(metres * unitsPerMetre); }

class ContactWorld final : b2ContactFilter, b2ContactListener {
public:
    /// Of the bodies [firstBody, lastBody) and the obstacles of their clusters.
    ContactWorld(const ContactTask& task, std::span<const ContactImpulse> before, std::size_t firstBody,
                 std::size_t lastBody, std::size_t firstObstacle, std::size_t lastObstacle)
        : task_(task), before_(before), first_(firstBody), world_(b2Vec2(0, 0)) {
        world_.SetAllowSleeping(false);
        world_.SetContactFilter(this);
        world_.SetContactListener(this);
        moves_.reserve(lastBody - firstBody);
        bodies_.reserve(lastBody - firstBody);
        for (std::size_t i = firstBody; i < lastBody; ++i) moves_.push_back(plannedMove(task.bodies[i]));
        steps_ = stepsNeeded();
        iterations_ = iterationsNeeded(lastBody, firstObstacle, lastObstacle);
        world_.SetContinuousPhysics(mayTunnel(lastBody, firstObstacle, lastObstacle));
        stepLength_ = static_cast<float>(task.duration / steps_);
        // Box2D scales saved impulses by the ratio of this step's length to the last one's, which it must first know.
        world_.Step(stepLength_, 0, 0);
        for (std::size_t i = firstBody; i < lastBody; ++i) addBody(i);
        addObstacles(firstObstacle, lastObstacle);
    }

    void solve(std::span<ContactOutcome> outcomes) {
        for (int i = 0; i < steps_; ++i) {
            world_.Step(stepLength_, iterations_, positionIterations);
            warm_ = false;
        }
        for (std::size_t i = 0; i < bodies_.size(); ++i) outcomes[first_ + i] = outcomeOf(bodies_[i], first_ + i);
    }

    void collect(std::vector<ContactImpulse>& impulses, std::vector<ContactReport>* reports) {
        for (b2Contact* contact = world_.GetContactList(); contact != nullptr; contact = contact->GetNext()) {
            if (!contact->IsTouching()) continue;
            const b2Manifold& manifold = *contact->GetManifold();
            for (int32 i = 0; i < manifold.pointCount; ++i) {
                const b2ManifoldPoint& point = manifold.points[i];
                if (point.normalImpulse <= 0) continue;
                ContactImpulse impulse = keyed(*contact);
                impulse.feature = point.id.key;
                impulse.normal = point.normalImpulse;
                impulse.tangent = point.tangentImpulse;
                impulses.push_back(impulse);
            }
            if (reports != nullptr) report(*contact, *reports);
        }
    }

private:
    struct Body {
        b2Body* body;
        b2Vec2 velocity;
        float rotation;
        b2Vec2 planned;
        float plannedAngle, angle;
        Point origin;
    };

    /// Each cluster has its own origin near it, so that float coordinates are fine everywhere.
    Point originOf(const ContactBody& body) const {
        constexpr double grid = 32;
        return {std::round(body.pose.x / grid) * grid, std::round(body.pose.y / grid) * grid};
    }

    /// How far a body's centre of mass is planned to go.
    static Point plannedMove(const ContactBody& b) {
        const Point move = position(b.planned) - position(b.pose);
        if (b.centre == Point{}) return move;
        return move + Placement(b.planned).rotate(b.centre) - Placement(b.pose).rotate(b.centre);
    }

    int stepsNeeded() const {
        double steps = 1;
        for (std::size_t i = 0; i < moves_.size(); ++i) {
            const ContactBody& b = task_.bodies[first_ + i];
            const double turn = std::abs(b.planned.heading - b.pose.heading);
            steps = std::max({steps, length(moves_[i]) * unitsPerMetre / longestMove, turn / largestTurn});
        }
        return static_cast<int>(std::ceil(std::min(steps, 1000.0)));
    }

    int iterationsNeeded(std::size_t lastBody, std::size_t firstObstacle, std::size_t lastObstacle) const {
        for (std::size_t i = first_, end = first_; i < lastBody; i = end) {
            double least = task_.bodies[i].mass, most = least;
            for (; end < lastBody && task_.bodies[end].cluster == task_.bodies[i].cluster; ++end) {
                least = std::min(least, task_.bodies[end].mass);
                most = std::max(most, task_.bodies[end].mass);
            }
            const std::uint32_t cluster = task_.bodies[i].cluster;
            const bool byObstacle = std::any_of(task_.obstacles.begin() + static_cast<std::ptrdiff_t>(firstObstacle),
                                                task_.obstacles.begin() + static_cast<std::ptrdiff_t>(lastObstacle),
                                                [&](const ContactObstacle& o) { return o.cluster == cluster; });
            if (end - i + (byObstacle ? 1 : 0) >= 3 && least < light * most) return squeezedIterations;
        }
        return velocityIterations;
    }

    /// Held between two others in the tick before.
    bool squeezed(std::uint32_t body) const {
        std::optional<std::pair<std::uint32_t, std::uint32_t>> partner;
        for (const ContactImpulse& c : before_) {
            if (c.bodyA != body && c.bodyB != body) continue;
            const auto other = c.bodyA == body ? std::pair{c.bodyB, c.bodyB == noBody ? c.pieceB : 0}
                                               : std::pair{c.bodyA, c.bodyA == noBody ? c.pieceA : 0};
            if (partner && *partner != other) return true;
            partner = other;
        }
        return false;
    }

    /// What a body's mass is multiplied by: the solver lets heavy bodies sink into a light one that they hold.
    double massFactor(const ContactBody& body) const {
        double heaviest = 0;
        for (const ContactBody& other : task_.bodies)
            if (other.cluster == body.cluster) heaviest = std::max(heaviest, other.mass);
        return body.mass < light * heaviest && squeezed(body.body) ? light * heaviest / body.mass : 1;
    }

    bool touchedBefore(std::uint32_t body, std::uint32_t obstacle) const {
        return std::any_of(before_.begin(), before_.end(), [&](const ContactImpulse& c) {
            return (c.bodyA == body && c.bodyB == noBody && c.pieceB == obstacle) ||
                   (c.bodyB == body && c.bodyA == noBody && c.pieceA == obstacle);
        });
    }

    bool mayTunnel(std::size_t lastBody, std::size_t firstObstacle, std::size_t lastObstacle) const {
        for (std::size_t i = first_; i < lastBody; ++i) {
            const ContactBody& b = task_.bodies[i];
            if (length(moves_[i - first_]) > farMove) return true;
            for (std::size_t k = firstObstacle; k < lastObstacle; ++k) {
                const std::uint32_t piece = task_.obstacles[k].piece;
                if (task_.obstacles[k].cluster != b.cluster || touchedBefore(b.body, piece)) continue;
                const Placement planned(b.planned);
                const ConvexPiece& obstacle = task_.obstacleShape->prepared().pieces[piece];
                const auto deep = [&](const ConvexPiece& own) {
                    return mayBeNearer(placed(own, planned), obstacle, -shallow);
                };
                const std::vector<ConvexPiece>& pieces = b.shape->prepared().pieces;
                if (std::any_of(pieces.begin(), pieces.end(), deep)) return true;
            }
        }
        return false;
    }

    void addBody(std::size_t index) {
        const ContactBody& b = task_.bodies[index];
        if (index == first_ || b.cluster != task_.bodies[index - 1].cluster) origin_ = originOf(b);
        const auto duration = static_cast<float>(task_.duration);
        const Point& move = moves_[index - first_];
        Body entry;
        entry.origin = origin_;
        entry.angle = static_cast<float>(wrapAngle(b.pose.heading));
        entry.velocity = {units(move.x) / duration, units(move.y) / duration};
        entry.rotation = static_cast<float>(b.planned.heading - b.pose.heading) / duration;
        b2BodyDef definition;
        definition.type = b2_dynamicBody;
        definition.position = {units(b.pose.x - origin_.x), units(b.pose.y - origin_.y)};
        definition.angle = entry.angle;
        definition.bullet = length(move) > farMove;
        entry.planned = {units(b.planned.x - origin_.x), units(b.planned.y - origin_.y)};
        entry.plannedAngle = entry.angle + static_cast<float>(b.planned.heading - b.pose.heading);
        entry.body = world_.CreateBody(&definition);
        const CollisionShape::Prepared& shape = b.shape->prepared();
        for (std::uint32_t piece = 0; piece < shape.shapes.size(); ++piece)
            addFixture(*entry.body, shape.shape(piece), {static_cast<std::uint32_t>(index), piece}, b.friction,
                       b.restitution);
        const double factor = massFactor(b);
        b2MassData mass;
        mass.mass = static_cast<float>(factor * b.mass);
        mass.center = {units(b.centre.x), units(b.centre.y)};
        // Box2D wants the moment about the body's origin, in its units.
        mass.I =
            static_cast<float>(factor * (b.inertia + b.mass * dot(b.centre, b.centre)) * unitsPerMetre * unitsPerMetre);
        entry.body->SetMassData(&mass);
        entry.body->SetLinearVelocity(entry.velocity);
        entry.body->SetAngularVelocity(entry.rotation);
        bodies_.push_back(entry);
    }

    static void addFixture(b2Body& body, const b2Shape& shape, Tag tag, double friction, double restitution) {
        b2FixtureDef fixture;
        fixture.shape = &shape;
        fixture.friction = static_cast<float>(friction);
        fixture.restitution = static_cast<float>(restitution);
        fixture.restitutionThreshold = bounceThreshold;
        fixture.userData.pointer = pack(tag);
        body.CreateFixture(&fixture);
    }

    void addObstacles(std::size_t first, std::size_t last) {
        if (first == last) return;
        const b2BodyDef definition;
        b2Body& ground = *world_.CreateBody(&definition);
        std::size_t body = first_;
        for (std::size_t i = first; i < last; ++i) {
            const ContactObstacle& obstacle = task_.obstacles[i];
            while (task_.bodies[body].cluster != obstacle.cluster) ++body;
            addPiece(ground, obstacle, static_cast<std::uint32_t>(task_.bodies.size() + i),
                     bodies_[body - first_].origin);
        }
    }

    /// A piece of the obstacles, relative to its cluster's origin.
    void addPiece(b2Body& ground, const ContactObstacle& obstacle, std::uint32_t index, const Point& origin) const {
        const CollisionShape::Prepared& all = task_.obstacleShape->prepared();
        const ConvexPiece& piece = all.pieces[obstacle.piece];
        const Tag tag{index, obstacle.piece};
        auto shape = all.shapes[obstacle.piece];
        if (auto* circle = std::get_if<b2CircleShape>(&shape)) {
            circle->m_p = {units(piece.centre.x - origin.x), units(piece.centre.y - origin.y)};
            addFixture(ground, *circle, tag, obstacle.friction, obstacle.restitution);
        } else if (auto* polygon = std::get_if<b2PolygonShape>(&shape)) {
            if (!(origin == Point{})) shift(*polygon, origin);
            addFixture(ground, *polygon, tag, obstacle.friction, obstacle.restitution);
        }
    }

    static void shift(b2PolygonShape& polygon, const Point& origin) {
        const b2Vec2 by(units(origin.x), units(origin.y));
        for (int32 i = 0; i < polygon.m_count; ++i) polygon.m_vertices[i] -= by;
        polygon.m_centroid -= by;
    }

    std::uint32_t clusterOf(std::uint32_t index) const {
        return index < task_.bodies.size() ? task_.bodies[index].cluster
                                           : task_.obstacles[index - task_.bodies.size()].cluster;
    }
    std::uint32_t bodyOf(std::uint32_t index) const {
        return index < task_.bodies.size() ? task_.bodies[index].body : noBody;
    }

    bool ShouldCollide(b2Fixture* a, b2Fixture* b) override {
        return clusterOf(tagOf(a).index) == clusterOf(tagOf(b).index);
    }

    ContactImpulse keyed(const b2Contact& contact) const {
        const Tag a = tagOf(contact.GetFixtureA()), b = tagOf(contact.GetFixtureB());
        return {bodyOf(a.index), a.piece, bodyOf(b.index), b.piece, 0, 0, 0};
    }

    void PreSolve(b2Contact* contact, const b2Manifold* /*old*/) override {
        if (!warm_) return;
        ContactImpulse impulse = keyed(*contact);
        vary(*contact, impulse);
        b2Manifold& manifold = *contact->GetManifold();
        for (int32 i = 0; i < manifold.pointCount; ++i) {
            impulse.feature = manifold.points[i].id.key;
            const auto found =
                std::lower_bound(before_.begin(), before_.end(), impulse,
                                 [](const ContactImpulse& x, const ContactImpulse& y) { return keyOf(x) < keyOf(y); });
            if (found == before_.end() || keyOf(*found) != keyOf(impulse)) continue;
            manifold.points[i].normalImpulse = found->normal;
            manifold.points[i].tangentImpulse = found->tangent;
            // Who leans on something does not bounce off it, though the wheels drive it there anew in every tick.
            contact->SetRestitution(0);
        }
    }

    /// The paper's random factor.
    void vary(b2Contact& contact, const ContactImpulse& pair) const {
        if (task_.randomFactor == 0) return;
        const std::uint32_t body = std::min(pair.bodyA, pair.bodyB), other = std::max(pair.bodyA, pair.bodyB);
        const auto factor = [&](NoiseChannel what) {
            const std::uint32_t channel = channelOf(what, other == noBody ? 0 : other + 1);
            const double u = uniformNoise({task_.seed, task_.tick, body, channel});
            return static_cast<float>(1 + task_.randomFactor * (2 * u - 1));
        };
        contact.SetRestitution(std::min(1.0F, contact.GetRestitution() * factor(NoiseChannel::restitution)));
        contact.SetFriction(contact.GetFriction() * factor(NoiseChannel::contactFriction));
    }

    ContactOutcome outcomeOf(const Body& entry, std::size_t index) const {
        const b2Vec2 velocity = entry.body->GetLinearVelocity();
        const b2Vec2 off = entry.body->GetPosition() - entry.planned;
        const float turned = entry.body->GetAngle() - entry.plannedAngle;
        ContactOutcome outcome;
        outcome.moved = !(velocity == entry.velocity) || entry.body->GetAngularVelocity() != entry.rotation ||
                        std::abs(off.x) > onPlan || std::abs(off.y) > onPlan || std::abs(turned) > onPlan;
        if (!outcome.moved) return outcome;
        const ContactBody& b = task_.bodies[index];
        outcome.pose = {b.planned.x + static_cast<double>(off.x) / unitsPerMetre,
                        b.planned.y + static_cast<double>(off.y) / unitsPerMetre,
                        b.planned.heading + static_cast<double>(turned)};
        const b2Vec2 atReference = entry.body->GetLinearVelocityFromLocalPoint(b2Vec2(0, 0));
        outcome.velocity_W = {static_cast<double>(atReference.x) / unitsPerMetre,
                              static_cast<double>(atReference.y) / unitsPerMetre,
                              static_cast<double>(entry.body->GetAngularVelocity())};
        return outcome;
    }

    void report(b2Contact& contact, std::vector<ContactReport>& reports) const {
        const Tag a = tagOf(contact.GetFixtureA()), b = tagOf(contact.GetFixtureB());
        const b2Manifold& manifold = *contact.GetManifold();
        b2WorldManifold where;
        contact.GetWorldManifold(&where);
        const bool bodyFirst = a.index < task_.bodies.size();
        const Body& known = bodies_[(bodyFirst ? a.index : b.index) - first_];
        ContactReport report;
        report.bodyA = bodyOf(bodyFirst ? a.index : b.index);
        report.bodyB = bodyOf(bodyFirst ? b.index : a.index);
        report.obstacle = report.bodyB == noBody ? (bodyFirst ? b.piece : a.piece) : 0;
        const double sense = bodyFirst ? 1 : -1;
        report.normal = {sense * static_cast<double>(where.normal.x), sense * static_cast<double>(where.normal.y)};
        Point sum;
        for (int32 i = 0; i < manifold.pointCount; ++i) {
            report.impulse += static_cast<double>(manifold.points[i].normalImpulse) / unitsPerMetre;
            sum = sum + Point{static_cast<double>(where.points[i].x), static_cast<double>(where.points[i].y)};
        }
        report.position = known.origin + (1 / (unitsPerMetre * std::max(1, manifold.pointCount))) * sum;
        reports.push_back(report);
    }

    const ContactTask& task_;
    std::span<const ContactImpulse> before_;
    std::size_t first_;
    b2World world_;
    std::vector<Point> moves_;  ///< of the centres of mass, m
    std::vector<Body> bodies_;
    Point origin_;
    int steps_ = 1, iterations_ = velocityIterations;
    float stepLength_ = 0.02F;
    bool warm_ = true;  ///< in the first step only
};

/// The end of the clusters that fit one world together with the cluster at `first`.
std::size_t worldEnd(const ContactTask& task, std::size_t first) {
    std::size_t end = std::min(first + bodiesPerWorld, task.bodies.size());
    if (end == task.bodies.size()) return end;
    while (end > first && task.bodies[end].cluster == task.bodies[end - 1].cluster) --end;
    if (end > first) return end;
    // One cluster larger than a world is one world.
    end = first + 1;
    while (end < task.bodies.size() && task.bodies[end].cluster == task.bodies[first].cluster) ++end;
    return end;
}

}  // namespace

void solveContacts(const ContactTask& task, std::span<const ContactImpulse> before, std::vector<ContactImpulse>& after,
                   std::vector<ContactOutcome>& outcomes, std::vector<ContactReport>* reports) {
    after.clear();
    outcomes.resize(task.bodies.size());
    std::size_t obstacle = 0;
    for (std::size_t first = 0; first < task.bodies.size();) {
        const std::size_t last = worldEnd(task, first);
        std::size_t obstacleEnd = obstacle;
        while (obstacleEnd < task.obstacles.size() &&
               task.obstacles[obstacleEnd].cluster <= task.bodies[last - 1].cluster)
            ++obstacleEnd;
        ContactWorld world(task, before, first, last, obstacle, obstacleEnd);
        world.solve(outcomes);
        world.collect(after, reports);
        first = last;
        obstacle = obstacleEnd;
    }
    std::sort(after.begin(), after.end(),
              [](const ContactImpulse& a, const ContactImpulse& b) { return keyOf(a) < keyOf(b); });
}

}  // namespace mrose
