#include "physics/contact_world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "physics/prepared_shape.h"
#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

constexpr int positionIterations = 3;
// Below this speed (units/s) bounces are dead: 5 cm/s.
constexpr float bounceThreshold = 0.5F;
// A path that differs by less than this (units) is the planned one, rounded to float.
constexpr float onPlan = 3e-4F;
constexpr double rounding = 1e-6;  // share of an energy

float units(double metres) { return static_cast<float>(metres * unitsPerMetre); }
b2Vec2 units(const Point& p) { return {units(p.x), units(p.y)}; }
double metres(float value) { return static_cast<double>(value) / unitsPerMetre; }

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
            moves_.push_back(plannedMove(task_->bodies[i]));
    effort_ = effortFor(*task_, clusters_, moves_, before_);
    // Box2D scales saved impulses by the ratio of this step's length to the last one's, which it must first know.
    world_.SetContinuousPhysics(false);
    if (effort_.stepLength != lastStep_) world_.Step(effort_.stepLength, 0, 0);
    lastStep_ = effort_.stepLength;
    world_.SetContinuousPhysics(effort_.continuous);
    for (const ContactCluster& cluster : clusters_)
        for (std::size_t i = cluster.firstBody; i < cluster.lastBody; ++i) addBody(i, cluster);
    for (const ContactCluster& cluster : clusters_)
        for (std::size_t i = cluster.firstObstacle; i < cluster.lastObstacle; ++i)
            addObstacle(task_->obstacles[i], cluster.origin);
}

void ContactWorld::empty() {
    if (groundBody_ != nullptr) world_.DestroyBody(groundBody_);
    groundBody_ = nullptr;
    for (auto entry = bodies_.rbegin(); entry != bodies_.rend(); ++entry) world_.DestroyBody(entry->body);
    bodies_.clear();
    moves_.clear();
    ground_.clear();
}

void ContactWorld::addBody(std::size_t index, const ContactCluster& cluster) {
    const ContactBody& b = task_->bodies[index];
    const PlannedMove& move = moves_[index - first_];
    Body& entry = bodies_.emplace_back();
    entry.cluster = &cluster;
    const auto duration = static_cast<float>(task_->duration), angle = static_cast<float>(wrapAngle(b.pose.heading));
    const auto turn = static_cast<float>(b.planned.heading - b.pose.heading);
    entry.velocity = (1 / duration) * units(move.way);
    entry.rotation = turn / duration;
    entry.planned = units(position(b.planned) - cluster.origin);
    entry.plannedAngle = angle + turn;
    b2BodyDef definition;
    definition.type = b2_dynamicBody;
    definition.position = units(position(b.pose) - cluster.origin);
    definition.angle = angle;
    definition.bullet = move.fast;
    entry.body = world_.CreateBody(&definition);
    const CollisionShape::Prepared& shape = b.shape->prepared();
    for (std::uint32_t piece = 0; piece < shape.shapes.size(); ++piece)
        addFixture(*entry.body, shape.shape(piece), pack({static_cast<std::uint32_t>(index), piece}), b.friction,
                   b.restitution);
    const double factor = heldMassFactor(b, cluster, before_);
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
    for (int i = 0; i < effort_.steps; ++i) {
        world_.Step(effort_.stepLength, effort_.iterations, positionIterations);
        warm_ = false;
    }
}

/// Where both bounce and rub, Newton's restitution may leave bodies with more energy than they had (Kane and Levinson
/// 1985), and so may what makes held bodies less light. Then what they move about their common motion, or about walls,
/// is made slower: what was separating still is.
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

/// Called with every solution, those of bounces within the tick too, whose impulses no manifold keeps.
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
