#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "control/controller.h"
#include "physics/collision_shape.h"
#include "scenario/drawn_values.h"
#include "scenario/log_player.h"
#include "scene/obstacle_index.h"
#include "scene/scene.h"
#include "sensing/sensor.h"
#include "world/past_poses.h"
#include "world/world_state.h"

namespace mrose {

/// How far trials of a scenario differ from it: uniform draws within +- these.
struct Variation {
    double robotPosition = 0;   ///< m, of starts, in x and in y; of people too
    double robotHeading = 0;    ///< rad
    double objectPosition = 0;  ///< m
    double frictionShare = 0;   ///< of the floor's frictions
    double massShare = 0;       ///< of the objects' masses
    bool operator==(const Variation&) const = default;
};

struct SavedState;

/// What a scenario is made of.
struct ScenarioParts {
    std::string name;
    Scene scene;
    std::vector<std::shared_ptr<const Controller>> controllers;  ///< of each robot
    std::vector<LogPlayer> players = {};                         ///< those of them that play a log
    std::uint64_t seed = 1;
    Nanoseconds duration = 60 * nanosecondsPerSecond;  ///< of a run that is not given another one
    Variation variation;
    bool kickOff = true;  ///< after a goal the ball lies at its start again
    /// Of a run that it begins with (saved_state.h); the starts of the scene's bodies are where it has them, or where
    /// they are to be moved. Null: all begin at their starts.
    std::shared_ptr<const SavedState> saved = nullptr;
    std::vector<Pose> kickOffPoses = {};  ///< of the objects, where these are not their starts
    /// For the trial of an experiment that it is. Null: it is none.
    std::shared_ptr<const DrawnValues> drawn = nullptr;
};

/// All that is constant in a run, with what is derived from it once: where in the state each robot's commands and
/// memory lie, and what contact needs. Periods must be multiples of the tick; one controller a robot.
class Scenario {
public:
    explicit Scenario(ScenarioParts parts);

    const ScenarioParts& parts() const { return parts_; }
    const Scene& scene() const { return parts_.scene; }
    const Controller& controller(std::size_t robot) const { return *parts_.controllers[robot]; }
    const ObstacleIndex& obstacles() const { return obstacles_; }

    WorldState initialState() const { return initialState(parts_.seed); }
    WorldState initialState(std::uint64_t seed) const;
    /// At tick 0 with all bodies at their starts, whatever it begins with.
    WorldState freshState(std::uint64_t seed) const;
    /// Where an object lies again after a goal.
    const Pose& kickOffPose(std::size_t object) const {
        return parts_.kickOffPoses.empty() ? parts_.scene.objects[object].start : parts_.kickOffPoses[object];
    }

    /// Where a robot's commands lie in WorldState::commands, its controller's memory in WorldState::memory.
    std::span<StampedCommand> commandSlots(WorldState& state, std::size_t robot) const {
        return std::span(state.commands).subspan(slots_[robot].commands, slots_[robot].commandCount);
    }
    std::span<const StampedCommand> commandSlots(const WorldState& state, std::size_t robot) const {
        return std::span(state.commands).subspan(slots_[robot].commands, slots_[robot].commandCount);
    }
    CommandView commandsOf(const WorldState& state, std::size_t robot) const {
        const RobotState& r = state.robots[robot];
        return CommandView({state.commands.data() + slots_[robot].commands, r.commandCount}, r.commandBefore);
    }
    std::span<std::byte> memoryOf(WorldState& state, std::size_t robot) const {
        return std::span(state.memory).subspan(slots_[robot].memory, slots_[robot].memorySize);
    }
    std::span<const std::byte> memoryOf(const WorldState& state, std::size_t robot) const {
        return std::span(state.memory).subspan(slots_[robot].memory, slots_[robot].memorySize);
    }
    /// Likewise what the motion model of a body, robot or object, remembers of it in WorldState::motion.
    std::span<std::byte> motionMemory(WorldState& state, std::size_t body) const {
        return std::span(state.motion).subspan(slots_[body].motion, slots_[body].motionSize);
    }
    std::span<const std::byte> motionMemory(const WorldState& state, std::size_t body) const {
        return std::span(state.motion).subspan(slots_[body].motion, slots_[body].motionSize);
    }
    /// Whether any object's motion model remembers something.
    bool objectsRemember() const { return objectsRemember_; }
    /// Its motion model begins anew.
    void forgetMotion(WorldState& state, std::size_t body) const;
    /// A robot's sensors: those that every robot has, then its type's own.
    std::span<const std::shared_ptr<const Sensor>> sensors(std::size_t robot) const {
        return sensors_[slots_[robot].type].all;
    }
    /// Which of the readings of a sensor its controller reads: bit k for Sensor::gives()[k].
    std::uint32_t wanted(std::size_t robot, std::size_t sensor) const { return wanted_[slots_[robot].wanted + sensor]; }
    /// Of each robot; noTeam: of none.
    std::span<const std::uint32_t> teams() const { return teams_; }
    /// What its controller reads.
    const Attention& attention(std::size_t robot) const { return attentions_[slots_[robot].attention]; }
    bool readsMessages(std::size_t robot) const { return slots_[robot].readsMessages; }
    /// What one of them remembers in WorldState::sensing.
    template <class State>
    auto sensorMemory(State& state, std::size_t robot, std::size_t sensor) const {
        return partOf(sensorMemory(state, robot), robot, sensor);
    }
    /// The same of what all of them remember.
    template <class Byte>
    std::span<Byte> partOf(std::span<Byte> all, std::size_t robot, std::size_t sensor) const {
        const auto [first, size] = sensors_[slots_[robot].type].memories[sensor];
        return all.subspan(first, size);
    }
    /// What all of them remember.
    std::span<std::byte> sensorMemory(WorldState& state, std::size_t robot) const {
        return std::span(state.sensing).subspan(slots_[robot].sensing, slots_[robot].sensingSize);
    }
    std::span<const std::byte> sensorMemory(const WorldState& state, std::size_t robot) const {
        return std::span(state.sensing).subspan(slots_[robot].sensing, slots_[robot].sensingSize);
    }
    /// The same of a controller's memory by itself.
    std::span<const std::byte> memoryOf(const std::vector<std::byte>& memory, std::size_t robot) const {
        return std::span(memory).subspan(slots_[robot].memory, slots_[robot].memorySize);
    }
    const PastPoses& past() const { return past_; }
    std::int64_t pastDepth() const { return past_.depth(); }
    /// For how many ticks WorldState::touches keeps those of robots that feel them; 0: there are none.
    std::int64_t touchDepth() const { return touchDepth_; }
    bool feelsTouches(std::size_t robot) const { return sensors_[slots_[robot].type].feelsTouches; }
    const Pose& poseBefore(const WorldState& state, std::size_t body, std::int64_t lag) const {
        return past_.poseBefore(state, body, lag);
    }
    static const Pose& poseOf(const WorldState& state, std::size_t body) { return mrose::poseOf(state, body); }

    /// A robot's control period.
    struct Period {
        std::int64_t ticks = 0;
        double seconds = 0;
    };
    const Period& periodOf(std::size_t robot) const { return periods_[robot]; }

    // What contact needs of a body, computed once.
    struct ContactBodyType {
        CollisionShape shape;
        Surface surface;
        double mass, inertia;  ///< kg; kg m2 about the centre of mass
        Point centre;
        double reach;
    };
    const ContactBodyType& contactType(std::size_t body) const { return contactTypes_[contactTypeOf_[body]]; }
    const CollisionShape& obstacleShape() const { return obstacleShape_; }

private:
    /// A cache line: with many robots it comes from far in every tick.
    struct alignas(64) Slots {
        std::size_t commands = 0, motion = 0, memory = 0, sensing = 0;  ///< where they begin
        std::uint32_t commandCount = 0, motionSize = 0, memorySize = 0, sensingSize = 0;
        std::uint32_t type = 0, wanted = 0, attention = 0;
        bool readsMessages = false;
    };
    /// Of a type of robots.
    struct Sensors {
        std::vector<std::shared_ptr<const Sensor>> all;
        std::vector<std::pair<std::size_t, std::size_t>> memories;  ///< of each, first byte and size
        bool feelsTouches = false;                                  ///< any of them
        std::size_t memorySize = 0;
    };
    void layOutSensors();
    void layOut();
    void prepareContacts();

    ScenarioParts parts_;
    ObstacleIndex obstacles_;
    CollisionShape obstacleShape_;
    std::vector<ContactBodyType> contactTypes_;
    std::vector<std::uint32_t> contactTypeOf_;
    std::vector<Slots> slots_;  ///< by body; objects have motion alone
    std::vector<Period> periods_;
    std::vector<std::uint32_t> teams_;
    std::vector<Sensors> sensors_;       ///< of each type
    std::vector<std::uint32_t> wanted_;  ///< of a robot's sensors, once for all with the same
    std::vector<Attention> attentions_;  ///< likewise
    std::size_t commandSlots_ = 0, motionSize_ = 0, memorySize_ = 0, sensingSize_ = 0;
    PastPoses past_;
    std::int64_t touchDepth_ = 0;
    bool objectsRemember_ = false;
};

}  // namespace mrose
