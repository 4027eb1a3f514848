#include <algorithm>
#include <cmath>
#include <numeric>

#include "simulation/floor_motion.h"
#include "simulation/step_stages.h"
#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

double shareOfPeriod(const Scenario& scenario, const WorldState& state, std::size_t robot) {
    return static_cast<double>(state.tick + 1 - state.robots[robot].segment.startTick) /
           static_cast<double>(scenario.periodOf(robot).ticks);
}

/// How far any point of a body gets between two poses, at most.
double travelOf(const Pose& from, const Pose& to, double reach) {
    return distance(position(from), position(to)) + reach * std::abs(to.heading - from.heading);
}

const Pose& plannedPose(const StepBuffers::Content& buffers, std::size_t body) {
    return body < buffers.paths.size() ? buffers.paths[body].pose : buffers.objects[body - buffers.paths.size()].pose;
}

bool atRest(const ObjectState& object) { return object.velocity_W == Twist{} && object.roll_W == Point{}; }

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
            type.surface.friction,
            type.surface.restitution,
            buffers.swept[body].pose,
            plannedPose(buffers, body)};
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
    std::vector<std::uint32_t> bodies;
    for (const auto& [a, b] : buffers.search.bodyPairs()) bodies.insert(bodies.end(), {a, b});
    for (const auto& [body, piece] : buffers.search.obstaclePairs()) bodies.push_back(body);
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
    for (const std::uint32_t body : bodies)
        task.bodies.push_back(contactBody(scenario, buffers, body, rootOf(buffers.cluster, body)));
    std::stable_sort(task.bodies.begin(), task.bodies.end(),
                     [](const ContactBody& a, const ContactBody& b) { return a.cluster < b.cluster; });
    for (const auto& [body, piece] : buffers.search.obstaclePairs()) {
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
        const double travel = travelOf(body.pose, buffers.outcomes[k].pose, body.shape->reach);
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
        solveContacts(buffers.task, state.contacts, buffers.impulses, buffers.outcomes,
                      trace != nullptr ? &trace->contacts : nullptr);
        if (!outranged(buffers)) return;
        const std::size_t pairs = buffers.search.bodyPairs().size(), walls = buffers.search.obstaclePairs().size();
        buffers.search.find(buffers.swept, scenario.obstacles());
        if (buffers.search.bodyPairs().size() == pairs && buffers.search.obstaclePairs().size() == walls) return;
    }
}

void moveRobot(const Scenario& scenario, WorldState& state, std::size_t robot, const ContactOutcome& outcome) {
    RobotState& r = state.robots[robot];
    r.pose = outcome.pose;
    const Point velocity = Placement(r.pose).rotateBack({outcome.velocity_W.x, outcome.velocity_W.y});
    r.velocity_B = {velocity.x, velocity.y, outcome.velocity_W.rotation};
    moveTo(r.segment, shareOfPeriod(scenario, state, robot), r.pose);
}

void commit(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers, StepTrace* trace) {
    const std::size_t robots = state.robots.size();
    for (std::size_t i = 0; i < robots; ++i) {
        state.robots[i].pose = buffers.paths[i].pose;
        state.robots[i].velocity_B = buffers.paths[i].velocity_B;
        if (trace != nullptr) trace->robots[i].planned = buffers.paths[i].pose;
    }
    std::swap(state.objects, buffers.objects);
    for (std::size_t k = 0; k < buffers.task.bodies.size(); ++k) {
        const ContactOutcome& outcome = buffers.outcomes[k];
        if (!outcome.moved) continue;
        const std::size_t body = buffers.task.bodies[k].body;
        if (body < robots) {
            moveRobot(scenario, state, body, outcome);
            if (trace != nullptr) trace->robots[body].touched = true;
        } else {
            state.objects[body - robots].pose = outcome.pose;
            state.objects[body - robots].velocity_W = outcome.velocity_W;
            if (trace != nullptr) trace->touchedObjects[body - robots] = true;
        }
    }
}

}  // namespace

void planFreeMotion(const Scenario& scenario, const WorldState& state, StepBuffers::Content& buffers) {
    const Scene& scene = scenario.scene();
    buffers.paths.resize(state.robots.size());
    buffers.swept.resize(state.robots.size() + state.objects.size());
    for (std::size_t i = 0; i < state.robots.size(); ++i) {
        const RobotState& robot = state.robots[i];
        buffers.paths[i] = at(robot.segment, shareOfPeriod(scenario, state, i), scenario.periodOf(i).seconds);
        const Shape& shape = *scene.typeOf(i).shape;
        buffers.swept[i] = {&shape, robot.pose, travelOf(robot.pose, buffers.paths[i].pose, shape.reach)};
    }
    buffers.objects.clear();
    for (std::size_t i = 0; i < state.objects.size(); ++i) {
        const ObjectState& object = state.objects[i];
        const ObjectType& type = scene.typeOfObject(i);
        const std::size_t body = state.robots.size() + i;
        const double u = scene.randomFactor == 0
                             ? 0
                             : 2 * uniformNoise({state.seed, state.tick, static_cast<std::uint32_t>(body),
                                                 channelOf(NoiseChannel::floorFriction)}) -
                                   1;
        buffers.objects.push_back(atRest(object)
                                      ? object
                                      : afterFloorMotion(object, type, scene.environment.floor,
                                                         1 + scene.randomFactor * u, toSeconds(scene.tickLength)));
        buffers.swept[body] = {type.shape.get(), object.pose,
                               travelOf(object.pose, buffers.objects[i].pose, type.shape->reach)};
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
            if (scenario.parts().kickOff) state.objects[i] = {scene.objects[i].start, {}, {}};
        }
}

}  // namespace mrose
