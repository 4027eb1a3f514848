#include "scenario/scenario.h"

#include <algorithm>
#include <cassert>

#include "scenario/saved_state.h"
#include "sensing/sensor_kinds.h"
#include "sensing/sensor_view.h"
#include "synthetic/reference_perception.h"

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

}  // namespace

Scenario::Scenario(ScenarioParts parts)
    : parts_(std::move(parts)),
      obstacles_(parts_.scene.environment, searchMargin(parts_.scene)),
      obstacleShape_(obstacles_.pieces()),
      teams_(teamsOf(parts_.scene)) {
    assert(parts_.controllers.size() == parts_.scene.robots.size());
    layOutSensors();
    layOut();
    prepareContacts();
}

void Scenario::layOutSensors() {
    for (const RobotType& type : scene().robotTypes) {
        Sensors& sensors = sensors_.emplace_back();
        const bool reference = type.perception.model == Perception::Model::reference;
        sensors.all =
            reference ? referenceSensors(type.perception, scene().environment) : standardSensors(type.perception);
        sensors.all.insert(sensors.all.end(), type.sensors.begin(), type.sensors.end());
        assert(sensors.all.size() <= SensorView::mostSensors);
        for (const auto& sensor : sensors.all) {
            assert(sensor->gives().size() <= SensorView::mostReadings);
            sensors.memories.emplace_back(sensors.memorySize, sensor->memorySize());
            sensors.feelsTouches = sensors.feelsTouches || sensor->feelsTouches();
            sensors.memorySize += paddedMemory(sensor->memorySize());
        }
    }
}

void Scenario::layOut() {
    const Scene& scene = parts_.scene;
    std::int64_t depth = 0;
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
        const MotionModel& model = scene.modelOf(i);
        assert(model.period() % scene.tickLength == 0);
        const auto periods = static_cast<std::size_t>(model.lookBack() / model.period()) + 2;
        Slots slots;
        slots.commands = commandSlots_;
        // None has more than the capacity, in however few periods.
        const std::size_t inPeriod =
            std::min(controller(i).commandsPerPeriod(model.period()), CommandHistory::capacity);
        slots.commandCount = static_cast<std::uint32_t>(std::min(periods * inPeriod, CommandHistory::capacity));
        slots.memory = memorySize_;
        slots.memorySize = static_cast<std::uint32_t>(controller(i).memorySize());
        slots.motion = motionSize_;
        slots.motionSize = static_cast<std::uint32_t>(model.memorySize());
        slots.type = scene.robots[i].type;
        slots.sensing = sensingSize_;
        slots.sensingSize = static_cast<std::uint32_t>(sensors_[slots.type].memorySize);
        const Attention attention = controller(i).attention();
        const auto same = std::find(attentions_.begin(), attentions_.end(), attention);
        slots.attention = static_cast<std::uint32_t>(same - attentions_.begin());
        if (same == attentions_.end()) attentions_.push_back(attention);
        slots.readsMessages = attention.reads(messagesReading);
        std::vector<std::uint32_t> wanted;
        for (const auto& sensor : sensors_[slots.type].all) {
            wanted.push_back(0);
            std::uint32_t bit = 1;
            for (const ReadingKind& kind : sensor->gives()) {
                if (attention.reads(kind.name)) wanted.back() |= bit;
                bit <<= 1;
            }
            // What is measured between two control instants is up to a period older when it is told.
            const std::int64_t between = sensor->period() > 0 ? model.period() / scene.tickLength - 1 : 0;
            const std::int64_t ticks =
                sensor->exact() ? sensor->lookBack() / scene.tickLength + 2 : scene.ticksOf(sensor->lookBack());
            depth = std::max(depth, ticks + between);
            if (!sensor->feelsTouches()) continue;
            // A measurement looks back to the one before, and there is one at each control instant, or by its own
            // clock.
            touchDepth_ = std::max(touchDepth_, (model.period() + sensor->period()) / scene.tickLength + 2);
        }
        const auto alike = std::search(wanted_.begin(), wanted_.end(), wanted.begin(), wanted.end());
        slots.wanted = static_cast<std::uint32_t>(alike - wanted_.begin());
        if (alike == wanted_.end()) wanted_.insert(wanted_.end(), wanted.begin(), wanted.end());
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
        slots.motionSize = static_cast<std::uint32_t>(scene.typeOfObject(i).motion->memorySize());
        motionSize_ += paddedMemory(slots.motionSize);
        objectsRemember_ = objectsRemember_ || slots.motionSize > 0;
        slots_.push_back(slots);
    }
    past_ = PastPoses(depth, scene.bodyCount());
}

void Scenario::prepareContacts() {
    const Scene& scene = parts_.scene;
    for (const RobotType& type : scene.robotTypes) {
        const Shape& shape = *type.shape;
        contactTypes_.push_back({CollisionShape(shape.pieces, shape.centroid), type.surface, type.mass,
                                 type.mass * shape.gyration * shape.gyration, shape.centroid, shape.reach});
    }
    for (const ObjectType& type : scene.objectTypes) {
        const Shape& shape = *type.shape;
        const double inertia = type.rolls ? type.inertia * shape.reach * shape.reach : shape.gyration * shape.gyration;
        contactTypes_.push_back({CollisionShape(shape.pieces, shape.centroid), type.surface, type.mass,
                                 type.mass * inertia, shape.centroid, shape.reach});
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
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
        const SceneRobot& robot = scene.robots[i];
        RobotState r;
        r.pose = r.segment.start = robot.start;
        r.segment.direction = Placement(robot.start).rotate({1, 0});
        r.velocity_B = {robot.velocity.v, 0, robot.velocity.w};
        r.nextControl = robot.phase;
        r.lastControl = r.nextControl - periodOf(i).ticks;
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
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
        const SceneRobot& robot = scene.robots[i];
        const MotionModel& model = scene.modelOf(i);
        model.start(motionMemory(state, i));
        model.adapt(motionMemory(state, i), robot.tracked);
        if (robot.sent.empty()) continue;
        CommandHistory sent;
        for (const StampedCommand& command : robot.sent) sent.issue(command.time, command.command);
        model.recall(motionMemory(state, i), sent, robot.phase * scene.tickLength);
    }
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        scene.typeOfObject(i).motion->start(motionMemory(state, scene.robots.size() + i));
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
        controller(i).start(memoryOf(state, i));
        for (std::size_t k = 0; k < sensors(i).size(); ++k) sensors(i)[k]->start(sensorMemory(state, i, k));
    }
    for (std::int64_t k = 0; k < pastDepth(); ++k)
        for (std::size_t body = 0; body < scene.bodyCount(); ++body) state.past.push_back(poseOf(state, body));
    return state;
}

void Scenario::forgetMotion(WorldState& state, std::size_t body) const {
    const std::size_t robots = scene().robots.size();
    const std::span<std::byte> memory = motionMemory(state, body);
    if (body < robots) return scene().modelOf(body).restart(memory);
    std::ranges::fill(memory, std::byte{0});
    scene().typeOfObject(body - robots).motion->start(memory);
}

}  // namespace mrose
