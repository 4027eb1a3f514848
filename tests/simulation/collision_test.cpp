// Oblique collisions against closed forms.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/small_world.h"
#include "support/shipped.h"
#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

struct Partner {
    double mass, inertia;  ///< kg, kg m2
    Twist velocity_W;      ///< of the centre of mass
    Point arm;             ///< from it to the point of contact
};

Point velocityThere(const Partner& p) {
    return {p.velocity_W.x - p.velocity_W.rotation * p.arm.y, p.velocity_W.y + p.velocity_W.rotation * p.arm.x};
}

/// What discs that touch at one point give one another by the laws of Newton (restitution along the normal, which
/// points from a to b) and Coulomb (the tangential impulse stops the sliding there, or is the normal one times
/// friction): N s, on b.
Point impulseOfDiscs(const Partner& a, const Partner& b, const Point& normal, double restitution, double friction) {
    const Point tangent{-normal.y, normal.x}, approach = velocityThere(b) - velocityThere(a);
    const double shared = 1 / a.mass + 1 / b.mass;
    const auto turned = [&](const Partner& p) { return dot(p.arm, p.arm) / p.inertia; };
    const double pressed = -(1 + restitution) * dot(approach, normal) / shared;
    const double stopping = -dot(approach, tangent) / (shared + turned(a) + turned(b));
    const double rubbed = std::clamp(stopping, -friction * pressed, friction * pressed);
    return pressed * normal + rubbed * tangent;
}

void give(Partner& p, const Point& impulse) {
    p.velocity_W.x += impulse.x / p.mass;
    p.velocity_W.y += impulse.y / p.mass;
    p.velocity_W.rotation += cross(p.arm, impulse) / p.inertia;
}

double energyOf(const Partner& p) {
    const Twist& v = p.velocity_W;
    return (p.mass * (v.x * v.x + v.y * v.y) + p.inertia * v.rotation * v.rotation) / 2;
}

Environment ice(Environment environment = {}) {
    environment.floor = {0, 0, 0};
    return environment;
}

/// A shipped robot as a body that no controller moves that slides over ice.
ObjectType adrift(const std::string& robot) {
    const RobotType type = shippedRobot(robot).type;
    return {robot, type.shape, type.mass, type.surface, false};
}

/// A ball that turns about the vertical only.
ObjectType shippedBall(double friction, double restitution) {
    ObjectType type = ballType();
    type.shape = shippedShape("ball");
    type.surface = {friction, restitution};
    return type;
}

Partner partner(const Scenario& scenario, const WorldState& state, std::size_t object) {
    const auto& type = scenario.contactType(object);
    const ObjectState& o = state.objects[object];
    const Point centre = Placement(o.pose).rotate(type.centre);
    const Twist& v = o.velocity_W;
    return {type.mass, type.inertia, {v.x - v.rotation * centre.y, v.y + v.rotation * centre.x, v.rotation}, {}};
}

bool sameVelocity(const Twist& a, const Twist& b) {
    return std::hypot(a.x - b.x, a.y - b.y) < 1e-4 && std::abs(a.rotation - b.rotation) < 1e-3;
}

/// Steps until the first object is turned from its way; the state before that tick.
WorldState stepToImpact(const Scenario& scenario, WorldState& state) {
    StepBuffers buffers;
    for (int k = 0; k < 500; ++k) {
        const WorldState before = state;
        step(scenario, state, buffers);
        if (!sameVelocity(before.objects[0].velocity_W, state.objects[0].velocity_W)) return before;
    }
    ADD_FAILURE() << "nothing touched";
    return state;
}

void expectVelocity(const Partner& found, const Partner& expected, double tolerance) {
    EXPECT_NEAR(found.velocity_W.x, expected.velocity_W.x, tolerance);
    EXPECT_NEAR(found.velocity_W.y, expected.velocity_W.y, tolerance);
    const double gyration = std::sqrt(expected.inertia / expected.mass);
    EXPECT_NEAR(gyration * found.velocity_W.rotation, gyration * expected.velocity_W.rotation, tolerance);
}

TEST(Collision, ObliqueBallOnAWallFollowsNewtonAndCoulomb) {
    for (const double friction : {0.0, 0.05, 0.2, 1.0})
        for (const double angle : {-1.2, -0.6, 0.2, 0.6, 1.2})
            for (const double spin : {-20.0, 2.0}) {
                SmallWorld world(ice(walledField(4, 40, {friction, 0})));
                world.object(shippedBall(friction, 0.6), {2, 20, 0}, {3 * std::cos(angle), 3 * std::sin(angle), spin});
                const Scenario scenario = world.scenario();
                WorldState state = scenario.initialState();
                Partner ball = partner(scenario, stepToImpact(scenario, state), 0);
                ball.arm = {0.11, 0};
                ball.inertia = 0.43 * 0.11 * 0.11 * 2 / 3;
                const Partner wall{1e12, 1e12, {}, {}};
                give(ball, -1 * impulseOfDiscs(ball, wall, {1, 0}, 0.6, friction));
                SCOPED_TRACE(std::to_string(friction) + ' ' + std::to_string(angle) + ' ' + std::to_string(spin));
                expectVelocity(partner(scenario, state, 0), ball, 0.006);
            }
}

/// However fast: a tick may be solved in steps, and the ball be off the wall again at its end.
TEST(Collision, BounceIsReportedWithItsImpulse) {
    for (const double speed : {0.5, 3.0, 9.0, 18.0, 40.0}) {
        SmallWorld world(ice(walledField(4, 4, {0, 0})));
        world.object(shippedBall(0, 0.6), {3, 2, 0}, {speed, 0.2 * speed, 0});
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        StepTrace trace;
        double impulse = 0;
        while (state.objects[0].velocity_W.x > 0) {
            step(scenario, state, buffers, {}, &trace);
            for (const ContactReport& contact : trace.contacts) impulse += contact.impulse;
        }
        EXPECT_NEAR(impulse, 0.43 * 1.6 * speed, 1e-4 * speed) << speed;
        ASSERT_EQ(trace.contacts.size(), 1u);
        EXPECT_NEAR(trace.contacts[0].position.x, 4, 0.03);
        EXPECT_NEAR(trace.contacts[0].normal.x, 1, 1e-6);
    }
}

/// The way from one disc's centre to another's when they meet: as they are, or within the next tick.
Point meetingOf(const ObjectState& a, const ObjectState& b, double sum) {
    const Point apart = position(b.pose) - position(a.pose);
    const Point closing{b.velocity_W.x - a.velocity_W.x, b.velocity_W.y - a.velocity_W.y};
    const double c = dot(apart, apart) - sum * sum, half = dot(apart, closing), square = dot(closing, closing);
    const double time = c <= 0 ? 0 : (-half - std::sqrt(half * half - square * c)) / square;
    return apart + time * closing;
}

/// Two round objects, the first on its way to the second at the origin: m/s, within `tolerance` of the momentum.
void expectImpactOfDiscs(const ObjectType& one, const ObjectType& other, double aside, const Twist& velocity,
                         double tolerance) {
    SmallWorld world(ice());
    world.object(one, {-1, aside, 0}, velocity).object(other, {0, 0, 0.4}, {-0.5, 0.1, 0.3});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    const WorldState before = stepToImpact(scenario, state);
    Partner a = partner(scenario, before, 0), b = partner(scenario, before, 1);
    const double r1 = one.shape->reach, r2 = other.shape->reach;
    const Point way = meetingOf(before.objects[0], before.objects[1], r1 + r2);
    const Point normal = (1 / length(way)) * way;
    a.inertia = one.mass * r1 * r1 * (one.rolls ? 2.0 / 3 : 0.5);
    b.inertia = other.mass * r2 * r2 * (other.rolls ? 2.0 / 3 : 0.5);
    a.arm = r1 * normal;
    b.arm = -r2 * normal;
    const Surface &first = one.surface, &second = other.surface;
    const Point impulse = impulseOfDiscs(a, b, normal, std::max(first.restitution, second.restitution),
                                         std::sqrt(first.friction * second.friction));
    give(a, -1 * impulse);
    give(b, impulse);
    SCOPED_TRACE(one.name + ' ' + other.name + ' ' + std::to_string(aside) + ' ' + std::to_string(first.friction));
    expectVelocity(partner(scenario, state, 0), a, tolerance);
    expectVelocity(partner(scenario, state, 1), b, tolerance * one.mass / other.mass);
}

TEST(Collision, ObliqueBallsAndRoundRobotsFollowNewtonAndCoulomb) {
    for (const char* robot : {"create", "nomad200", "b21"})
        for (const double aside : {-0.15, 0.05, 0.2})
            for (const double friction : {0.0, 0.04, 0.3})
                expectImpactOfDiscs(shippedBall(friction, 0.6), adrift(robot), aside, {4, 0.3, 5}, 0.08);
}

TEST(Collision, ObliqueRoundRobotsFollowNewtonAndCoulomb) {
    for (const char* one : {"create", "nomad200", "b21"})
        for (const char* other : {"create", "nomad200", "b21"})
            for (const double aside : {-0.15, 0.05, 0.2})
                expectImpactOfDiscs(adrift(one), adrift(other), aside, {0.9, 0.1, 2}, 0.02);
}

struct Sum {
    Point momentum;                  ///< N s
    double angular = 0, energy = 0;  ///< N m s about the world's origin; J
};

Sum sumOf(const Scenario& scenario, const WorldState& state) {
    Sum sum;
    for (std::size_t i = 0; i < state.objects.size(); ++i) {
        const Partner p = partner(scenario, state, i);
        const Point momentum = p.mass * Point{p.velocity_W.x, p.velocity_W.y};
        const Point centre = Placement(state.objects[i].pose).place(scenario.contactType(i).centre);
        sum.momentum = sum.momentum + momentum;
        sum.angular += cross(centre, momentum) + p.inertia * p.velocity_W.rotation;
        sum.energy += energyOf(p);
    }
    return sum;
}

/// Outlines of any form: what no collision may change, and how far the impulse may lean aside.
TEST(Collision, ObliqueRobotsKeepTheirMomentumAndLoseEnergy) {
    std::size_t impacts = 0;
    std::vector<ObjectType> robots;
    for (const char* name : {"pioneer1", "nomad200", "create", "husky", "b21", "human"}) robots.push_back(adrift(name));
    for (const ObjectType& one : robots)
        for (const ObjectType& other : robots)
            for (std::int64_t trial = 0; trial < 6; ++trial) {
                const auto draw = [&](std::uint32_t c) { return 2 * uniformNoise({3, trial, 0, c}) - 1; };
                SmallWorld world(ice());
                world.object(one, {-1.2, 0.2 * draw(0), pi * draw(1)}, {0.9, 0.2 * draw(2), 0.5 * draw(3)});
                world.object(other, {0, 0, pi * draw(4)}, {-0.4, 0.2 * draw(5), 0.5 * draw(6)});
                const Scenario scenario = world.scenario();
                const double friction =
                    std::sqrt(scenario.contactType(0).surface.friction * scenario.contactType(1).surface.friction);
                WorldState state = scenario.initialState();
                const Sum start = sumOf(scenario, state);
                StepTrace trace;
                StepBuffers buffers;
                SCOPED_TRACE(one.name + ' ' + other.name + ' ' + std::to_string(trial));
                std::size_t touches = 0;
                for (int k = 0; k < 150; ++k) {
                    const WorldState before = state;
                    step(scenario, state, buffers, {}, &trace);
                    const Sum sum = sumOf(scenario, state), last = sumOf(scenario, before);
                    const double scale = length(start.momentum) + 1;
                    ASSERT_NEAR(sum.momentum.x, start.momentum.x, 1e-5 * scale);
                    ASSERT_NEAR(sum.momentum.y, start.momentum.y, 1e-5 * scale);
                    ASSERT_LE(sum.energy, last.energy * (1 + 1e-5));
                    // What presses overlapping bodies apart may shift them a little.
                    ASSERT_NEAR(sum.angular, start.angular, 0.02 * scale);
                    touches += trace.contacts.size();
                    if (trace.contacts.size() != 1) continue;
                    const Partner was = partner(scenario, before, 1), is = partner(scenario, state, 1);
                    const Point speed{is.velocity_W.x - was.velocity_W.x, is.velocity_W.y - was.velocity_W.y};
                    const double sense = trace.contacts[0].bodyB == 1 ? 1 : -1;
                    const Point given = is.mass * speed, normal = sense * trace.contacts[0].normal;
                    if (length(given) < 0.1) continue;
                    ++impacts;
                    // The normal is told as it is at the tick's end.
                    ASSERT_LE(std::abs(cross(normal, given)), 1.25 * friction * dot(normal, given));
                }
                EXPECT_GT(touches, 0u);
            }
    EXPECT_GT(impacts, 100u);
}

}  // namespace
}  // namespace mrose
