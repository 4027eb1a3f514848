#include "physics/contact_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "physics/prepared_shape.h"
#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

// Box2D limits a step to 2 units and a quarter turn.
constexpr double longestMove = 1.5, largestTurn = 1.2;
constexpr int velocityIterations = 8, positionIterations = 3;
// A light body squeezed between heavy ones needs more: each iteration leaves heavy / (heavy + light) of the error.
constexpr int squeezedIterations = 40;
// A body of less than this share of another one's mass is light beside it.
constexpr double light = 0.25, heldShare = 0.5;
// Below this speed (units/s) bounces are dead: 5 cm/s.
constexpr float bounceThreshold = 0.5F;
// A path that differs by less than this (units) is the planned one, rounded to float.
constexpr float onPlan = 3e-4F;
// A body that moves farther than this share of its reach in a tick needs continuous collision, with other moving ones
// too.
constexpr double farMove = 0.1;
// Continuous collision takes a quarter of a step's time. Bodies that only lean on what they touched before do without,
// and those that would come less deep (m) into something new, which the solver presses out again.
constexpr double shallow = 0.002;
constexpr double rounding = 1e-6;  // share of an energy

float units(double metres) { return static_cast<float>(metres * unitsPerMetre); }
b2Vec2 units(const Point& p) { return {units(p.x), units(p.y)}; }
double metres(float value) { return static_cast<double>(value) / unitsPerMetre; }

auto tied(const ContactImpulse& c) { return std::tie(c.bodyA, c.pieceA, c.bodyB, c.pieceB, c.feature); }

/// How far a body's centre of mass is planned to go.
Point plannedMove(const ContactBody& b) {
    const Point move = position(b.planned) - position(b.pose);
    if (b.centre == Point{}) return move;
    return move + Placement(b.planned).rotate(b.centre) - Placement(b.pose).rotate(b.centre);
}

void addFixture(b2Body& body, const b2Shape& shape, std::uintptr_t tag, double friction, double restitution) {
    b2FixtureDef fixture;
    fixture.shape = &shape;
    fixture.friction = static_cast<float>(friction);
    fixture.restitution = static_cast<float>(restitution);
    fixture.restitutionThreshold = bounceThreshold;
    fixture.userData.pointer = tag;
    body.CreateFixture(&fixture);
}

void shift(b2PolygonShape& polygon, const b2Vec2& by) {
    for (int32 i = 0; i < polygon.m_count; ++i) polygon.m_vertices[i] -= by;
    polygon.m_centroid -= by;
}

}  // namespace

bool keyLess(const ContactImpulse& a, const ContactImpulse& b) { return tied(a) < tied(b); }

ContactWorld::ContactWorld() : world_(b2Vec2(0, 0)) {
    world_.SetAllowSleeping(false);
    world_.SetContactFilter(this);
    world_.SetContactListener(this);
}

void ContactWorld::solve(const ContactTask& task, std::span<const ContactImpulse> before,
                         std::span<const ContactCluster> clusters, std::span<ContactOutcome> outcomes,
                         std::vector<ContactImpulse>& impulses, std::vector<ContactReport>* reports) {
    task_ = &task;
    before_ = before;
    clusters_ = clusters;
    reports_ = reports;
    reported_.clear();
    first_ = clusters.front().firstBody;
    fill();
    run();
    for (const ContactCluster& cluster : clusters_) takeBackEnergy(cluster);
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        outcomes[first_ + i] = outcomeOf(bodies_[i], task.bodies[first_ + i]);
    collect(impulses);
    empty();
}

void ContactWorld::fill() {
    for (const ContactCluster& cluster : clusters_)
        for (std::size_t i = cluster.firstBody; i < cluster.lastBody; ++i)
            bodies_.push_back(planOf(task_->bodies[i], cluster));
    chooseSteps();
    // Box2D scales saved impulses by the ratio of this step's length to the last one's, which it must first know.
    world_.SetContinuousPhysics(false);
    if (stepLength_ != lastStep_) world_.Step(stepLength_, 0, 0);
    lastStep_ = stepLength_;
    world_.SetContinuousPhysics(mayTunnel());
    for (std::size_t i = 0; i < bodies_.size(); ++i) addBody(first_ + i);
    for (const ContactCluster& cluster : clusters_)
        for (std::size_t i = cluster.firstObstacle; i < cluster.lastObstacle; ++i)
            addObstacle(task_->obstacles[i], cluster.origin);
}

void ContactWorld::empty() {
    if (groundBody_ != nullptr) world_.DestroyBody(groundBody_);
    groundBody_ = nullptr;
    for (auto entry = bodies_.rbegin(); entry != bodies_.rend(); ++entry) world_.DestroyBody(entry->body);
    bodies_.clear();
    ground_.clear();
}

ContactWorld::Body ContactWorld::planOf(const ContactBody& body, const ContactCluster& cluster) {
    Body entry{};
    entry.move = plannedMove(body);
    entry.fast = length(entry.move) > farMove * body.reach;
    entry.cluster = &cluster;
    return entry;
}

void ContactWorld::chooseSteps() {
    double steps = 1;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const ContactBody& b = task_->bodies[first_ + i];
        const double turn = std::abs(b.planned.heading - b.pose.heading);
        steps = std::max({steps, length(bodies_[i].move) * unitsPerMetre / longestMove, turn / largestTurn});
    }
    steps_ = static_cast<int>(std::ceil(std::min(steps, 1000.0)));
    stepLength_ = static_cast<float>(task_->duration / steps_);
    const bool squeeze = std::any_of(clusters_.begin(), clusters_.end(), [](const ContactCluster& c) {
        return c.members() >= 3 && c.lightest < light * c.heaviest;
    });
    iterations_ = squeeze ? squeezedIterations : velocityIterations;
}

bool ContactWorld::mayTunnel() const {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (bodies_[i].fast || tunnels(task_->bodies[first_ + i], *bodies_[i].cluster)) return true;
    return false;
}

bool ContactWorld::tunnels(const ContactBody& body, const ContactCluster& cluster) const {
    const std::vector<ConvexPiece>& pieces = body.shape->prepared().pieces;
    for (std::size_t k = cluster.firstObstacle; k < cluster.lastObstacle; ++k) {
        const std::uint32_t piece = task_->obstacles[k].piece;
        if (touchedBefore(body.body, piece)) continue;
        const ConvexPiece& obstacle = task_->obstacleShape->prepared().pieces[piece];
        const Placement planned(body.planned);
        for (const ConvexPiece& own : pieces)
            if (mayBeNearer(placed(own, planned), obstacle, -shallow)) return true;
    }
    return false;
}

bool ContactWorld::touchedBefore(std::uint32_t body, std::uint32_t piece) const {
    // The solver puts either of the two first, by their kinds of shape.
    auto at = std::lower_bound(before_.begin(), before_.end(), ContactImpulse{body, 0, 0, 0, 0, 0, 0}, keyLess);
    for (; at != before_.end() && at->bodyA == body; ++at)
        if (at->bodyB == noBody && at->pieceB == piece) return true;
    at = std::lower_bound(before_.begin(), before_.end(), ContactImpulse{noBody, piece, body, 0, 0, 0, 0}, keyLess);
    return at != before_.end() && at->bodyA == noBody && at->pieceA == piece && at->bodyB == body;
}

/// Held between two others in the tick before.
bool ContactWorld::squeezed(std::uint32_t body) const {
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

void ContactWorld::addBody(std::size_t index) {
    const ContactBody& b = task_->bodies[index];
    Body& entry = bodies_[index - first_];
    const ContactCluster& cluster = *entry.cluster;
    const auto duration = static_cast<float>(task_->duration), angle = static_cast<float>(wrapAngle(b.pose.heading));
    const auto turn = static_cast<float>(b.planned.heading - b.pose.heading);
    entry.velocity = (1 / duration) * units(entry.move);
    entry.rotation = turn / duration;
    entry.planned = units(position(b.planned) - cluster.origin);
    entry.plannedAngle = angle + turn;
    b2BodyDef definition;
    definition.type = b2_dynamicBody;
    definition.position = units(position(b.pose) - cluster.origin);
    definition.angle = angle;
    definition.bullet = entry.fast;
    entry.body = world_.CreateBody(&definition);
    const CollisionShape::Prepared& shape = b.shape->prepared();
    for (std::uint32_t piece = 0; piece < shape.shapes.size(); ++piece)
        addFixture(*entry.body, shape.shape(piece), pack({static_cast<std::uint32_t>(index), piece}), b.friction,
                   b.restitution);
    // The solver lets heavy bodies sink into a light one that they hold between them, unless it is less light.
    const bool held = b.mass < light * cluster.heaviest && squeezed(b.body);
    const double factor = held ? heldShare * cluster.heaviest / b.mass : 1;
    b2MassData mass;
    mass.mass = static_cast<float>(factor * b.mass);
    mass.center = units(b.centre);
    // Box2D wants the moment about the body's origin, in its units.
    mass.I =
        static_cast<float>(factor * (b.inertia + b.mass * dot(b.centre, b.centre)) * unitsPerMetre * unitsPerMetre);
    entry.body->SetMassData(&mass);
    entry.body->SetLinearVelocity(entry.velocity);
    entry.body->SetAngularVelocity(entry.rotation);
}

void ContactWorld::addObstacle(const ContactObstacle& obstacle, const Point& origin) {
    const auto same = [&](const Ground& g) { return g.piece == obstacle.piece && g.origin == origin; };
    if (std::any_of(ground_.begin(), ground_.end(), same)) return;
    if (groundBody_ == nullptr) {
        // Of this type, though it stands still, it makes one island of all that lean on it: each has a cost of its own.
        b2BodyDef definition;
        definition.type = b2_kinematicBody;
        groundBody_ = world_.CreateBody(&definition);
    }
    const CollisionShape::Prepared& all = task_->obstacleShape->prepared();
    const std::uintptr_t tag =
        pack({static_cast<std::uint32_t>(task_->bodies.size() + ground_.size()), obstacle.piece});
    ground_.push_back({obstacle.piece, origin});
    auto shape = all.shapes[obstacle.piece];
    if (auto* circle = std::get_if<b2CircleShape>(&shape))
        circle->m_p = units(all.pieces[obstacle.piece].centre - origin);
    else if (auto* polygon = std::get_if<b2PolygonShape>(&shape); polygon != nullptr && !(origin == Point{}))
        shift(*polygon, units(origin));
    std::visit([&](const auto& s) { addFixture(*groundBody_, s, tag, obstacle.friction, obstacle.restitution); },
               shape);
}

void ContactWorld::run() {
    warm_ = true;
    for (int i = 0; i < steps_; ++i) {
        world_.Step(stepLength_, iterations_, positionIterations);
        warm_ = false;
    }
}

/// Where both bounce and rub, Newton's restitution may leave bodies with more energy than they had (Kane and Levinson
/// 1985), and so may what makes held bodies less light. Then what they move about their common motion, or about walls,
/// is made slower: who was parting still is.
void ContactWorld::takeBackEnergy(const ContactCluster& cluster) {
    double before = 0, after = 0, mass = 0;
    Point momentum;
    const auto touched = [](const Body& entry) {
        return !(entry.body->GetLinearVelocity() == entry.velocity) ||
               entry.body->GetAngularVelocity() != entry.rotation;
    };
    for (std::size_t i = cluster.firstBody; i < cluster.lastBody; ++i) {
        const Body& entry = bodies_[i - first_];
        if (!touched(entry)) continue;
        const ContactBody& b = task_->bodies[i];
        const double inertia = b.inertia * unitsPerMetre * unitsPerMetre;
        const auto twice = [&](const b2Vec2& v, double w) {
            return b.mass * static_cast<double>(v.LengthSquared()) + inertia * w * w;
        };
        before += twice(entry.velocity, entry.rotation);
        after += twice(entry.body->GetLinearVelocity(), entry.body->GetAngularVelocity());
        mass += b.mass;
        const b2Vec2& velocity = entry.body->GetLinearVelocity();
        momentum = momentum + b.mass * Point{velocity.x, velocity.y};
    }
    if (after <= before * (1 + rounding)) return;
    Point common = (1 / mass) * momentum;
    double kept = mass * dot(common, common);
    if (cluster.lastObstacle > cluster.firstObstacle || kept >= before) {
        common = {0, 0};
        kept = 0;
    }
    const double share = std::sqrt((before - kept) / (after - kept));
    for (std::size_t i = cluster.firstBody; i < cluster.lastBody; ++i) {
        const Body& entry = bodies_[i - first_];
        if (!touched(entry)) continue;
        const b2Vec2& velocity = entry.body->GetLinearVelocity();
        const Point slower = common + share * (Point{velocity.x, velocity.y} - common);
        entry.body->SetLinearVelocity({static_cast<float>(slower.x), static_cast<float>(slower.y)});
        entry.body->SetAngularVelocity(static_cast<float>(share) * entry.body->GetAngularVelocity());
    }
}

ContactOutcome ContactWorld::outcomeOf(const Body& entry, const ContactBody& body) const {
    const b2Vec2 off = entry.body->GetPosition() - entry.planned;
    const float turned = entry.body->GetAngle() - entry.plannedAngle;
    ContactOutcome outcome;
    outcome.moved = !(entry.body->GetLinearVelocity() == entry.velocity) ||
                    entry.body->GetAngularVelocity() != entry.rotation || std::abs(off.x) > onPlan ||
                    std::abs(off.y) > onPlan || std::abs(turned) > onPlan;
    if (!outcome.moved) return outcome;
    outcome.pose = {body.planned.x + metres(off.x), body.planned.y + metres(off.y),
                    body.planned.heading + static_cast<double>(turned)};
    const b2Vec2 atReference = entry.body->GetLinearVelocityFromLocalPoint(b2Vec2(0, 0));
    outcome.velocity_W = {metres(atReference.x), metres(atReference.y),
                          static_cast<double>(entry.body->GetAngularVelocity())};
    return outcome;
}

void ContactWorld::collect(std::vector<ContactImpulse>& impulses) {
    for (b2Contact* contact = world_.GetContactList(); contact != nullptr; contact = contact->GetNext()) {
        if (!contact->IsTouching()) continue;
        const b2Manifold& manifold = *contact->GetManifold();
        for (int32 i = 0; i < manifold.pointCount; ++i) {
            const b2ManifoldPoint& point = manifold.points[i];
            if (point.normalImpulse <= 0) continue;
            ContactImpulse impulse = keyOf(*contact);
            impulse.feature = point.id.key;
            impulse.normal = point.normalImpulse;
            impulse.tangent = point.tangentImpulse;
            impulses.push_back(impulse);
        }
    }
}

/// Told of every solution, those of bounces within the tick too, whose impulses no manifold keeps.
void ContactWorld::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
    if (reports_ == nullptr) return;
    double sum = 0;
    for (int32 i = 0; i < impulse->count; ++i) sum += metres(impulse->normalImpulses[i]);
    report(*contact, sum);
}

void ContactWorld::report(b2Contact& contact, double impulse) {
    Tag a = tagOf(contact.GetFixtureA()), b = tagOf(contact.GetFixtureB());
    b2WorldManifold where;
    contact.GetWorldManifold(&where);
    double sense = 1;
    if (a.index >= task_->bodies.size()) {
        std::swap(a, b);
        sense = -1;
    }
    ContactReport report;
    report.bodyA = bodyOf(a.index);
    report.bodyB = bodyOf(b.index);
    report.obstacle = report.bodyB == noBody ? b.piece : 0;
    report.normal = {sense * static_cast<double>(where.normal.x), sense * static_cast<double>(where.normal.y)};
    const int32 count = contact.GetManifold()->pointCount;
    Point sum;
    for (int32 i = 0; i < count; ++i) sum = sum + Point{metres(where.points[i].x), metres(where.points[i].y)};
    report.position = bodies_[a.index - first_].cluster->origin + (1.0 / std::max(1, count)) * sum;
    report.impulse = impulse;
    const std::pair pair{contact.GetFixtureA(), contact.GetFixtureB()};
    const auto known = std::find(reported_.begin(), reported_.end(), pair);
    if (known == reported_.end()) {
        reported_.push_back(pair);
        reports_->push_back(report);
        return;
    }
    ContactReport& earlier = *(reports_->end() - (reported_.end() - known));
    report.impulse += earlier.impulse;
    earlier = report;
}

ContactWorld::Tag ContactWorld::tagOf(b2Fixture* fixture) {
    const std::uintptr_t data = fixture->GetUserData().pointer;
    return {static_cast<std::uint32_t>(data >> 32), static_cast<std::uint32_t>(data)};
}

std::uint32_t ContactWorld::bodyOf(std::uint32_t index) const {
    return index < task_->bodies.size() ? task_->bodies[index].body : noBody;
}

ContactImpulse ContactWorld::keyOf(b2Contact& contact) const {
    const Tag a = tagOf(contact.GetFixtureA()), b = tagOf(contact.GetFixtureB());
    return {bodyOf(a.index), a.piece, bodyOf(b.index), b.piece, 0, 0, 0};
}

bool ContactWorld::ShouldCollide(b2Fixture* a, b2Fixture* b) {
    std::size_t first = tagOf(a).index, second = tagOf(b).index;
    if (first >= task_->bodies.size()) std::swap(first, second);
    const ContactCluster& cluster = *bodies_[first - first_].cluster;
    if (second < task_->bodies.size()) return bodies_[second - first_].cluster == &cluster;
    return ground_[second - task_->bodies.size()].origin == cluster.origin;
}

void ContactWorld::PreSolve(b2Contact* contact, const b2Manifold* /*old*/) {
    if (!warm_) return;
    ContactImpulse impulse = keyOf(*contact);
    vary(*contact, impulse);
    b2Manifold& manifold = *contact->GetManifold();
    for (int32 i = 0; i < manifold.pointCount; ++i) {
        impulse.feature = manifold.points[i].id.key;
        const auto found = std::lower_bound(before_.begin(), before_.end(), impulse, keyLess);
        if (found == before_.end() || keyLess(impulse, *found)) continue;
        manifold.points[i].normalImpulse = found->normal;
        manifold.points[i].tangentImpulse = found->tangent;
        // Who leans on something does not bounce off it, though the wheels drive it there anew in every tick.
        contact->SetRestitution(0);
    }
}

/// The paper's random factor.
void ContactWorld::vary(b2Contact& contact, const ContactImpulse& pair) const {
    if (task_->randomFactor == 0) return;
    const std::uint32_t body = std::min(pair.bodyA, pair.bodyB), other = std::max(pair.bodyA, pair.bodyB);
    const auto factor = [&](NoiseChannel what) {
        const std::uint32_t channel = channelOf(what, other == noBody ? 0 : other + 1);
        const double u = uniformNoise({task_->seed, task_->tick, body, channel});
        return static_cast<float>(1 + task_->randomFactor * (2 * u - 1));
    };
    contact.SetRestitution(std::min(1.0F, contact.GetRestitution() * factor(NoiseChannel::restitution)));
    contact.SetFriction(contact.GetFriction() * factor(NoiseChannel::contactFriction));
}

}  // namespace mrose
