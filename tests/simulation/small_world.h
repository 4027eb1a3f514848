#pragma once

#include <utility>
#include <vector>

#include "motion/kinematic.h"
#include "simulation/step.h"
#include "support/scenes.h"

namespace mrose {

/// Tells a robot one thing all the time, or things by time.
class Told final : public Controller {
public:
    explicit Told(const Command& command) : commands_{{0, command}} {}
    explicit Told(std::vector<StampedCommand> commands) : commands_(std::move(commands)) {}
    void decide(const Observation& observation, std::span<std::byte> /*memory*/, Decision& decision) const override {
        for (const StampedCommand& c : commands_)
            if (c.time <= observation.time) decision.command = c.command;
    }

private:
    std::vector<StampedCommand> commands_;
};

/// A scenario put together body by body.
class SmallWorld {
public:
    explicit SmallWorld(Environment environment = {}) { parts_.scene.environment = std::move(environment); }

    SmallWorld& robot(const RobotType& type, const Pose& start, std::shared_ptr<const Controller> controller,
                      std::shared_ptr<const MotionModel> model, std::int64_t phase = 0) {
        Scene& scene = parts_.scene;
        const auto index = static_cast<std::uint32_t>(scene.robots.size());
        scene.robotTypes.push_back(type);
        scene.models.push_back(std::move(model));
        scene.robots.push_back({std::to_string(index + 1), index, index, phase, start});
        parts_.controllers.push_back(std::move(controller));
        return *this;
    }
    SmallWorld& object(const ObjectType& type, const Pose& start, const Twist& velocity = {}) {
        Scene& scene = parts_.scene;
        const auto index = static_cast<std::uint32_t>(scene.objects.size());
        scene.objectTypes.push_back(type);
        scene.objects.push_back({type.name + std::to_string(index), index, start, velocity});
        return *this;
    }
    ScenarioParts& parts() { return parts_; }
    Scenario scenario() const { return Scenario(parts_); }

private:
    ScenarioParts parts_;
};

inline std::shared_ptr<const MotionModel> ideal() {
    return std::make_shared<const KinematicModel>(KinematicParameters{});
}

inline void run(const Scenario& scenario, WorldState& state, int ticks) {
    StepBuffers buffers;
    for (int i = 0; i < ticks; ++i) step(scenario, state, buffers);
}

}  // namespace mrose
