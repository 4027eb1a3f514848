#include "scenario/scenario.h"

#include <algorithm>
#include <cassert>

#include "scenario/saved_state.h"

namespace mrose {
namespace {

/// How far round a body obstacles are looked for: its reach and what one moves in a tick that is as fast as robots and
/// kicked balls usually are. What is faster is compared with all obstacles.
double searchMargin(const Scene& scene) {
    constexpr double usual = 12;  // m/s
    double reach = 0;
    for (const RobotType& type : scene.robotTypes) reach = std::max(reach, type.shape->reach);
    for (const ObjectType& type : scene.objectTypes) reach = std::max(reach, type.shape->reach);
    return reach + usual * toSeconds(scene.tickLength) + 0.05;
}

std::int64_t longestLag(const Scene& scene) {
    Nanoseconds longest = 0;
    for (const RobotType& type : scene.robotTypes)
        longest = std::max(
            {longest, type.perception.self.latency, type.perception.objects.latency, type.perception.robots.latency});
    return scene.ticksOf(longest);
}

}  // namespace

Scenario::Scenario(ScenarioParts parts)
    : parts_(std::move(parts)),
      obstacles_(parts_.scene.environment, searchMargin(parts_.scene)),
      obstacleShape_(obstacles_.pieces()) {
    assert(parts_.controllers.size() == parts_.scene.robots.size());
    layOut();
    prepareContacts();
}

void Scenario::layOut() {
    const Scene& scene = parts_.scene;
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
        const MotionModel& model = scene.modelOf(i);
        assert(model.period() % scene.tickLength == 0);
        const auto periods = static_cast<std::size_t>(model.lookBack() / model.period()) + 2;
        Slots slots;
        slots.commands = commandSlots_;
        // Nobody has more than the capacity, in however few periods.
        const std::size_t inPeriod =
            std::min(controller(i).commandsPerPeriod(model.period()), CommandHistory::capacity);
        slots.commandCount = std::min(periods * inPeriod, CommandHistory::capacity);
        slots.memory = memorySize_;
        slots.memorySize = controller(i).memorySize();
        slots.motion = motionSize_;
        slots.motionSize = model.memorySize();
        slots.sensing = sensingSize_;
        slots.sensingSize = sizeof(SensorMemory);
        commandSlots_ += slots.commandCount;
        motionSize_ += paddedMemory(slots.motionSize);
        memorySize_ += paddedMemory(slots.memorySize);
        sensingSize_ += paddedMemory(slots.sensingSize);
        slots_.push_back(slots);
        periods_.push_back({model.period() / scene.tickLength, toSeconds(model.period())});
    }
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        Slots slots;
        slots.motion = motionSize_;
        slots.motionSize = scene.typeOfObject(i).motion->memorySize();
        motionSize_ += paddedMemory(slots.motionSize);
        objectsRemember_ = objectsRemember_ || slots.motionSize > 0;
        slots_.push_back(slots);
    }
    pastDepth_ = longestLag(scene);
}

void Scenario::prepareContacts() {
    const Scene& scene = parts_.scene;
    for (const RobotType& type : scene.robotTypes) {
        const Shape& shape = *type.shape;
        contactTypes_.push_back({CollisionShape(shape.pieces), type.surface, type.mass,
                                 type.mass * shape.gyration * shape.gyration, shape.centroid, shape.reach});
    }
    for (const ObjectType& type : scene.objectTypes) {
        const Shape& shape = *type.shape;
        const double inertia = type.rolls ? type.inertia * shape.reach * shape.reach : shape.gyration * shape.gyration;
        contactTypes_.push_back(
            {CollisionShape(shape.pieces), type.surface, type.mass, type.mass * inertia, shape.centroid, shape.reach});
    }
    for (const SceneRobot& robot : scene.robots) contactTypeOf_.push_back(robot.type);
    for (const SceneObject& object : scene.objects)
        contactTypeOf_.push_back(static_cast<std::uint32_t>(scene.robotTypes.size()) + object.type);
}

WorldState Scenario::initialState(std::uint64_t seed) const {
    return parts_.saved ? restored(*parts_.saved, *this, seed) : freshState(seed);
}

WorldState Scenario::freshState(std::uint64_t seed) const {
    const Scene& scene = parts_.scene;
    WorldState state;
    state.seed = seed;
    for (const SceneRobot& robot : scene.robots) {
        RobotState r;
        r.pose = r.segment.start = robot.start;
        r.segment.direction = Placement(robot.start).rotate({1, 0});
        r.velocity_B = {robot.velocity.v, 0, robot.velocity.w};
        r.nextControl = robot.phase;
        state.robots.push_back(r);
    }
    for (const SceneObject& object : scene.objects) {
        const Twist& v = object.velocity_W;
        // A ball that starts with a speed starts rolling.
        state.objects.push_back({object.start, v, {v.x, v.y}});
    }
    state.goals.assign(scene.environment.goals.size(), 0);
    state.commands.resize(commandSlots_);
    state.motion.resize(motionSize_);
    state.memory.resize(memorySize_);
    state.sensing.resize(sensingSize_);
    for (std::size_t body = 0; body < scene.bodyCount(); ++body) startMotion(state, body);
    for (std::size_t i = 0; i < scene.robots.size(); ++i) controller(i).start(memoryOf(state, i));
    for (std::int64_t k = 0; k < pastDepth_; ++k)
        for (std::size_t body = 0; body < scene.bodyCount(); ++body) state.past.push_back(poseOf(state, body));
    return state;
}

void Scenario::startMotion(WorldState& state, std::size_t body) const {
    const std::size_t robots = scene().robots.size();
    const std::span<std::byte> memory = motionMemory(state, body);
    if (body < robots)
        scene().modelOf(body).start(memory);
    else
        scene().typeOfObject(body - robots).motion->start(memory);
}

void Scenario::forgetMotion(WorldState& state, std::size_t body) const {
    std::ranges::fill(motionMemory(state, body), std::byte{0});
    startMotion(state, body);
}

const Pose& Scenario::poseBefore(const WorldState& state, std::size_t body, std::int64_t lag) const {
    return lag == 0 ? poseOf(state, body) : posesBefore(state, lag)[body];
}

std::span<const Pose> Scenario::posesBefore(const WorldState& state, std::int64_t lag) const {
    assert(lag > 0 && lag <= pastDepth_);
    // Slot k of the ring holds the poses of the newest tick that is k modulo the depth; ticks before 0 stand for the
    // start.
    const std::int64_t slot = ((state.tick - lag) % pastDepth_ + pastDepth_) % pastDepth_;
    const std::size_t bodies = parts_.scene.bodyCount();
    return std::span(state.past).subspan(static_cast<std::size_t>(slot) * bodies, bodies);
}

}  // namespace mrose
