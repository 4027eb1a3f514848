#pragma once

#include <memory>

#include "manipulation/learned_kicker.h"
#include "simulation/small_world.h"
#include "support/planted_kicker.h"
#include "support/units.h"

namespace mrose {

/// Drives on, and kicks at its control instants until `last`.
class DrivingKicker final : public Controller {
public:
    explicit DrivingKicker(Nanoseconds last) : last_(last) {}
    void decide(const Observation& observation, std::span<std::byte> /*memory*/, Decision& decision) const override {
        decision.command = Command{0.2, 0.3};
        if (observation.time <= last_) decision.kicks.push_back({0, 0.8});
    }

private:
    Nanoseconds last_;
};

/// Its robot has plantedKicker(), and a ball before it.
inline Scenario kickingScenario(std::uint64_t seed, Nanoseconds last = 0,
                                std::shared_ptr<const MotionModel> model = ideal()) {
    static const auto learned = std::make_shared<const LearnedKicker>(plantedKicker(0.1));
    RobotType type = squareRobot();
    type.manipulators = {{.name = "kicker", .position = {0.225, 0}, .recharge = 300 * ms, .learned = learned}};
    SmallWorld world;
    world.parts().seed = seed;
    const Pose start{1, 1, 0.5};
    world.robot(type, start, std::make_shared<const DrivingKicker>(last), std::move(model));
    world.object(ballType(), start * Pose{0.42, 0.04, 0});
    return world.scenario();
}

}  // namespace mrose
