#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/floor_motion.h"
#include "simulation/step_stages.h"
#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

double shareOfPeriod(const Scenario& scenario, const RobotState& robot, std::size_t index, std::int64_t tick) {
    return static_cast<double>(tick - robot.segment.startTick) / static_cast<double>(scenario.periodOf(index).ticks);
}

/// Where a robot gets in this tick if nothing touches it.
Recovery freeMotion(const Scenario& scenario, const WorldState& state, std::size_t index) {
    const Scene& scene = scenario.scene();
    const RobotState& robot = state.robots[index];
    const double period = scenario.periodOf(index).seconds;
    const double share = shareOfPeriod(scenario, robot, index, state.tick + 1);
    if (!robot.pushed) return {at(robot.segment, share, period), false};
    const PathPoint onWay = fromStart(robot.segment, shareOfPeriod(scenario, robot, index, state.tick), period);
    const Shape& shape = *scene.typeOf(index).shape;
    const double turnLever = 0.5 * shape.reach / std::max(1e-4, shape.gyration * shape.gyration);
    return recover({robot.pose, robot.velocity_B}, onWay, fromStart(robot.segment, share, period),
                   toSeconds(scene.tickLength), scene.environment.floor.traction * gravity, turnLever);
}

std::uint32_t rootOf(std::vector<std::uint32_t>& cluster, std::uint32_t body) {
    while (cluster[body] != body) body = cluster[body] = cluster[cluster[body]];
    return body;
}

/// Bodies that may touch one another, directly or through others, are one cluster, named by its first body.
void findClusters(StepBuffers::Content& buffers) {
    std::vector<std::uint32_t>& cluster = buffers.cluster;
    cluster.resize(buffers.swept.size());
    std::iota(cluster.begin(), cluster.end(), 0);
    for (const TouchSearch::Pair& pair : buffers.search.bodyPairs()) {
        const std::uint32_t a = rootOf(cluster, pair.a), b = rootOf(cluster, pair.b);
        cluster[std::max(a, b)] = std::min(a, b);
    }
}

ContactBody contactBody(const Scenario& scenario, const StepBuffers::Content& buffers, std::uint32_t body,
                        std::uint32_t cluster) {
    const Scenario::ContactBodyType& type = scenario.contactType(body);
    return {body,
            cluster,
            &type.shape,
            type.mass,
            type.inertia,
            type.centre,
            type.reach,
            type.surface.friction,
            type.surface.restitution,
            buffers.swept[body].pose,
            buffers.swept[body].planned};
}

void makeTask(const Scenario& scenario, const WorldState& state, StepBuffers::Content& buffers) {
    findClusters(buffers);
    ContactTask& task = buffers.task;
    task.bodies.clear();
    task.obstacles.clear();
    task.obstacleShape = &scenario.obstacleShape();
    task.duration = toSeconds(scenario.scene().tickLength);
    task.randomFactor = scenario.scene().randomFactor;
    task.seed = state.seed;
    task.tick = state.tick;
    // Clusters in which no pair meets need no solver.
    std::vector<std::uint32_t>& bodies = buffers.touching;
    std::vector<bool>& meets = buffers.meets;
    meets.assign(buffers.swept.size(), false);
    bodies.clear();
    for (const TouchSearch::Pair& pair : buffers.search.bodyPairs()) {
        bodies.insert(bodies.end(), {pair.a, pair.b});
        if (pair.meet) meets[rootOf(buffers.cluster, pair.a)] = true;
    }
    for (const TouchSearch::Pair& pair : buffers.search.obstaclePairs()) {
        bodies.push_back(pair.a);
        if (pair.meet) meets[rootOf(buffers.cluster, pair.a)] = true;
    }
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    std::erase_if(bodies, [&](std::uint32_t body) { return !meets[rootOf(buffers.cluster, body)]; });
    for (const std::uint32_t body : bodies)
        task.bodies.push_back(contactBody(scenario, buffers, body, rootOf(buffers.cluster, body)));
    std::sort(task.bodies.begin(), task.bodies.end(), [](const ContactBody& a, const ContactBody& b) {
        return a.cluster != b.cluster ? a.cluster < b.cluster : a.body < b.body;
    });
    for (const auto& [body, piece, meet] : buffers.search.obstaclePairs()) {
        if (!meets[rootOf(buffers.cluster, body)]) continue;
        const Surface& surface = scenario.obstacles().surfaceOf(piece);
        task.obstacles.push_back({piece, rootOf(buffers.cluster, body), surface.friction, surface.restitution});
    }
    const auto key = [](const ContactObstacle& o) { return std::pair{o.cluster, o.piece}; };
    std::sort(task.obstacles.begin(), task.obstacles.end(),
              [&](const ContactObstacle& a, const ContactObstacle& b) { return key(a) < key(b); });
    const auto same = [&](const ContactObstacle& a, const ContactObstacle& b) { return key(a) == key(b); };
    task.obstacles.erase(std::unique(task.obstacles.begin(), task.obstacles.end(), same), task.obstacles.end());
}

/// Whether contact has sent a body farther than the search for touches took into account.
bool outranged(StepBuffers::Content& buffers) {
    bool any = false;
    for (std::size_t k = 0; k < buffers.task.bodies.size(); ++k) {
        if (!buffers.outcomes[k].moved) continue;
        SweptBody& body = buffers.swept[buffers.task.bodies[k].body];
        const double travel = SweptBody::of(*body.shape, body.pose, buffers.outcomes[k].pose).travel;
        if (travel <= body.travel + TouchSearch::margin / 2) continue;
        body.travel = travel;
        any = true;
    }
    return any;
}

void solve(const Scenario& scenario, const WorldState& state, StepBuffers::Content& buffers, StepTrace* trace) {
    constexpr int mostRounds = 4;
    for (int round = 0; round < mostRounds; ++round) {
        makeTask(scenario, state, buffers);
        if (trace != nullptr) trace->contacts.clear();
        if (buffers.task.bodies.empty()) return;
        buffers.solver.solve(buffers.task, state.contacts, buffers.impulses, buffers.outcomes,
                             trace != nullptr ? &trace->contacts : nullptr);
        if (!outranged(buffers)) return;
        const std::size_t pairs = buffers.search.bodyPairs().size(), walls = buffers.search.obstaclePairs().size();
        buffers.search.find(buffers.swept, scenario.obstacles());
        if (buffers.search.bodyPairs().size() == pairs && buffers.search.obstaclePairs().size() == walls) return;
    }
}

void moveRobot(RobotState& r, const ContactOutcome& outcome) {
    r.pose = outcome.pose;
    const Point velocity = Placement(r.pose).rotateBack({outcome.velocity_W.x, outcome.velocity_W.y});
    r.velocity_B = {velocity.x, velocity.y, outcome.velocity_W.rotation};
    r.pushed = true;
}

ObjectInput objectInput(const Scenario& scenario, WorldState& state, std::size_t object, const ObjectState& from,
                        double duration) {
    const Scene& scene = scenario.scene();
    const std::size_t body = state.robots.size() + object;
    const NoiseKey noise{state.seed, state.tick, static_cast<std::uint32_t>(body),
                         channelOf(NoiseChannel::floorFriction)};
    return {from,  scene.typeOfObject(object),        scene.environment.floor, scene.randomFactor, duration,
            noise, scenario.motionMemory(state, body)};
}

/// Contact acts on what an object does in the tick's middle: the floor has worked on it for half of the tick, and does
/// for the other half. `memory`: of all motion models, when the tick began.
ObjectState touchedObject(const Scenario& scenario, WorldState& state, std::size_t object, const ObjectState& before,
                          const ContactOutcome& outcome, const std::vector<std::byte>& memory) {
    const ObjectModel& model = *scenario.scene().typeOfObject(object).motion;
    const double half = toSeconds(scenario.scene().tickLength) / 2;
    if (const std::span own = scenario.motionMemory(state, state.robots.size() + object); !own.empty())
        std::copy_n(memory.begin() + (own.data() - state.motion.data()), own.size(), own.begin());
    const Point roll = heldInPlace(model, objectInput(scenario, state, object, before, half)).roll_W;
    const ObjectState touched{outcome.pose, outcome.velocity_W, roll};
    return heldInPlace(model, objectInput(scenario, state, object, touched, half));
}

void commit(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers, StepTrace* trace) {
    const std::size_t robots = state.robots.size();
    for (std::size_t i = 0; i < robots; ++i) {
        RobotState& robot = state.robots[i];
        const auto& [point, recovering] = buffers.paths[i];
        robot.pose = point.pose;
        robot.velocity_B = point.velocity_B;
        if (robot.pushed && !recovering)
            moveTo(robot.segment, shareOfPeriod(scenario, robot, i, state.tick + 1), robot.pose);
        robot.pushed = recovering;
        if (trace != nullptr) trace->robots[i].planned = point.pose;
    }
    std::swap(state.objects, buffers.objects);
    for (std::size_t k = 0; k < buffers.task.bodies.size(); ++k) {
        const ContactOutcome& outcome = buffers.outcomes[k];
        if (!outcome.moved) continue;
        const std::size_t body = buffers.task.bodies[k].body;
        if (body < robots) {
            moveRobot(state.robots[body], outcome);
            if (trace != nullptr) trace->robots[body].touched = true;
        } else {
            const ObjectState& before = buffers.objects[body - robots];
            state.objects[body - robots] =
                touchedObject(scenario, state, body - robots, before, outcome, buffers.motion);
            if (trace != nullptr) trace->touchedObjects[body - robots] = true;
        }
    }
}

}  // namespace

void planFreeMotion(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers) {
    const Scene& scene = scenario.scene();
    buffers.paths.resize(state.robots.size());
    buffers.swept.resize(state.robots.size() + state.objects.size());
    for (std::size_t i = 0; i < state.robots.size(); ++i) {
        buffers.paths[i] = freeMotion(scenario, state, i);
        const Pose& pose = state.robots[i].pose;
        const Shape& shape = *scene.typeOf(i).shape;
        buffers.swept[i] = SweptBody::of(shape, pose, buffers.paths[i].point.pose);
    }
    buffers.objects.clear();
    if (scenario.objectsRemember()) buffers.motion = state.motion;
    for (std::size_t i = 0; i < state.objects.size(); ++i) {
        const ObjectState& object = state.objects[i];
        const ObjectType& type = scene.typeOfObject(i);
        const std::size_t body = state.robots.size() + i;
        buffers.objects.push_back(
            type.motion->after(objectInput(scenario, state, i, object, toSeconds(scene.tickLength))));
        buffers.swept[body] = SweptBody::of(*type.shape, object.pose, buffers.objects[i].pose);
    }
}

void resolveContacts(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers, StepTrace* trace) {
    buffers.search.find(buffers.swept, scenario.obstacles());
    buffers.task.bodies.clear();
    buffers.impulses.clear();
    if (!buffers.search.bodyPairs().empty() || !buffers.search.obstaclePairs().empty())
        solve(scenario, state, buffers, trace);
    std::swap(state.contacts, buffers.impulses);
    commit(scenario, state, buffers, trace);
}

void countGoals(const Scenario& scenario, WorldState& state, const StepBuffers::Content& buffers, StepTrace* trace) {
    const Scene& scene = scenario.scene();
    for (std::uint32_t g = 0; g < scene.environment.goals.size(); ++g)
        for (std::size_t i = 0; i < state.objects.size(); ++i) {
            const Polygon& area = scene.environment.goals[g].area;
            const bool arrived = contains(area, position(state.objects[i].pose)) &&
                                 !contains(area, position(buffers.swept[state.robots.size() + i].pose));
            if (!arrived || !scene.typeOfObject(i).rolls) continue;
            ++state.goals[g];
            if (trace != nullptr) trace->goals.push_back(g);
            if (!scenario.parts().kickOff) continue;
            state.objects[i] = {scenario.kickOffPose(i), {}, {}};
            scenario.forgetMotion(state, state.robots.size() + i);
        }
}

}  // namespace mrose
