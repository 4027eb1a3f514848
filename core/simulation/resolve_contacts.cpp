#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "physics/kept_impulses.h"
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

ContactBody contactBody(const Scenario& scenario, StepBuffers::Content& buffers, std::uint32_t body) {
    const Scenario::ContactBodyType& type = scenario.contactType(body);
    return {body,
            &type.shape,
            buffers.search.piecesOf(buffers.swept[body], body),
            type.mass,
            type.inertia,
            type.centre,
            type.reach,
            type.surface.friction,
            type.surface.restitution,
            buffers.swept[body].pose,
            buffers.swept[body].planned};
}

/// Sorts the pairs that the search found by cluster, but for clusters that need not be solved.
void sortByCluster(StepBuffers::Content& buffers, const std::vector<bool>& solves) {
    std::vector<StepBuffers::Content::ClusterPair>& pairs = buffers.pairs;
    pairs.clear();
    const auto add = [&](const TouchSearch::Pair& pair, bool grounded) {
        if (const std::uint32_t root = rootOf(buffers.cluster, pair.a); solves[root])
            pairs.push_back({root, pair.a, pair.b, grounded});
    };
    for (const TouchSearch::Pair& pair : buffers.search.bodyPairs()) add(pair, false);
    for (const TouchSearch::Pair& pair : buffers.search.obstaclePairs()) add(pair, true);
    std::stable_sort(pairs.begin(), pairs.end(), [](const auto& p, const auto& q) { return p.cluster < q.cluster; });
}

/// The cluster whose pairs these are. Its bodies are in the order of where they are: what they do to each other does
/// not depend on their numbers.
void fillCluster(const Scenario& scenario, StepBuffers::Content& buffers,
                 std::span<const StepBuffers::Content::ClusterPair> pairs) {
    ContactCluster& cluster = buffers.contacts;
    cluster.clear();
    std::vector<std::uint32_t>& members = buffers.touching;
    members.clear();
    for (const auto& pair : pairs) {
        members.push_back(pair.a);
        if (!pair.grounded) members.push_back(pair.b);
    }
    std::sort(members.begin(), members.end(), [&](std::uint32_t p, std::uint32_t q) {
        const Pose &a = buffers.swept[p].pose, &b = buffers.swept[q].pose;
        return std::tie(a.x, a.y, a.heading, p) < std::tie(b.x, b.y, b.heading, q);
    });
    members.erase(std::unique(members.begin(), members.end()), members.end());
    buffers.place.resize(buffers.swept.size());
    for (const std::uint32_t body : members) buffers.search.piecesOf(buffers.swept[body], body);  // may move others'
    for (const std::uint32_t body : members) {
        buffers.place[body] = static_cast<std::uint32_t>(cluster.bodies.size());
        cluster.bodies.push_back(contactBody(scenario, buffers, body));
    }
    for (const auto& pair : pairs) {
        const std::uint32_t a = buffers.place[pair.a];
        if (!pair.grounded) {
            const std::uint32_t b = buffers.place[pair.b];
            cluster.pairs.push_back({std::min(a, b), std::max(a, b)});
            continue;
        }
        const Surface& surface = scenario.obstacles().surfaceOf(pair.b);
        cluster.obstacles.push_back({a, pair.b, surface.friction, surface.restitution});
    }
    std::sort(cluster.pairs.begin(), cluster.pairs.end(),
              [](const BodyPair& p, const BodyPair& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
    std::sort(cluster.obstacles.begin(), cluster.obstacles.end(), [](const ObstaclePair& p, const ObstaclePair& q) {
        return std::tie(p.body, p.piece) < std::tie(q.body, q.piece);
    });
}

ContactTick contactTick(const Scenario& scenario, const WorldState& state) {
    const Scene& scene = scenario.scene();
    return {&scenario.obstacleShape(), toSeconds(scene.tickLength), scene.randomFactor, state.seed, state.tick};
}

/// Solves the clusters of buffers.pairs. What contact sent farther than the search for touches took into account is in
/// buffers.outranged then.
void solveClusters(const Scenario& scenario, const WorldState& state, StepBuffers::Content& buffers, bool reported) {
    const ContactTick tick = contactTick(scenario, state);
    buffers.outranged.clear();
    for (std::size_t first = 0, last = 0; first < buffers.pairs.size(); first = last) {
        while (last < buffers.pairs.size() && buffers.pairs[last].cluster == buffers.pairs[first].cluster) ++last;
        fillCluster(scenario, buffers, std::span(buffers.pairs).subspan(first, last - first));
        const std::size_t count = buffers.contacts.bodies.size();
        buffers.outcomes.resize(count);
        buffers.solver.solve(tick, buffers.contacts, state.contacts, buffers.impulses, buffers.outcomes,
                             reported ? &buffers.reports : nullptr);
        for (std::size_t i = 0; i < count; ++i) {
            const ContactOutcome& outcome = buffers.outcomes[i];
            if (!outcome.moved) continue;
            const std::uint32_t body = buffers.contacts.bodies[i].body;
            buffers.moved.push_back({body, outcome});
            SweptBody& swept = buffers.swept[body];
            if (outcome.travel <= swept.travel + TouchSearch::margin / 2) continue;
            swept.travel = 2 * outcome.travel;
            buffers.outranged.push_back(body);
        }
    }
}

/// Takes back what was found for the bodies of the clusters that are solved again.
void forgetClusters(StepBuffers::Content& buffers, const std::vector<bool>& solves) {
    const auto again = [&](std::uint32_t body) { return solves[rootOf(buffers.cluster, body)]; };
    std::erase_if(buffers.moved, [&](const auto& moved) { return again(moved.body); });
    std::erase_if(buffers.impulses, [&](const ContactImpulse& impulse) { return again(impulse.bodyA); });
    std::erase_if(buffers.reports, [&](const ContactReport& report) { return again(report.bodyA); });
}

/// Clusters in which no pair meets need no solver. Where contact sends a body farther than the search knew, whom it may
/// reach there is looked for; if there is somebody new, its cluster, which is larger now, is solved again.
void solve(const Scenario& scenario, const WorldState& state, StepBuffers::Content& buffers, bool reported) {
    findClusters(buffers);
    std::vector<bool>& solves = buffers.solves;
    solves.assign(buffers.swept.size(), false);
    for (const TouchSearch::Pair& pair : buffers.search.bodyPairs())
        if (pair.meet) solves[rootOf(buffers.cluster, pair.a)] = true;
    for (const TouchSearch::Pair& pair : buffers.search.obstaclePairs())
        if (pair.meet) solves[rootOf(buffers.cluster, pair.a)] = true;
    sortByCluster(buffers, solves);
    solveClusters(scenario, state, buffers, reported);
    while (!buffers.outranged.empty()) {
        const std::vector<std::uint32_t> met =
            buffers.search.widen(buffers.swept, buffers.outranged, scenario.obstacles());
        if (met.empty()) break;
        findClusters(buffers);
        solves.assign(buffers.swept.size(), false);
        for (const std::uint32_t body : met) solves[rootOf(buffers.cluster, body)] = true;
        forgetClusters(buffers, solves);
        sortByCluster(buffers, solves);
        solveClusters(scenario, state, buffers, reported);
    }
    std::sort(buffers.impulses.begin(), buffers.impulses.end(), keyLess);
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
    for (const auto& [body, outcome] : buffers.moved) {
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

void rememberTouches(const Scenario& scenario, WorldState& state, std::span<const ContactReport> reports) {
    const std::int64_t now = state.tick + 1;
    std::erase_if(state.touches, [&](const RobotTouch& touch) { return touch.tick <= now - scenario.touchDepth(); });
    for (const ContactReport& report : reports)
        for (const auto& [robot, other] :
             {std::pair(report.bodyA, report.bodyB), std::pair(report.bodyB, report.bodyA)}) {
            if (robot >= state.robots.size() || !scenario.feelsTouches(robot)) continue;
            state.touches.push_back(
                {now, robot, other, Placement(state.robots[robot].pose).placeBack(report.position)});
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
    buffers.search.find(buffers.swept, scenario.obstacles(), state.contacts);
    buffers.moved.clear();
    buffers.impulses.clear();
    buffers.reports.clear();
    if (!buffers.search.bodyPairs().empty() || !buffers.search.obstaclePairs().empty())
        solve(scenario, state, buffers, trace != nullptr || scenario.touchDepth() > 0);
    std::swap(state.contacts, buffers.impulses);
    commit(scenario, state, buffers, trace);
    if (scenario.touchDepth() > 0) rememberTouches(scenario, state, buffers.reports);
    if (trace != nullptr) trace->contacts = buffers.reports;
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
