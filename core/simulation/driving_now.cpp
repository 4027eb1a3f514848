#include "simulation/driving_now.h"

#include "motion/learned_model.h"

namespace mrose {

const DrivingReader* familiarDriving(const Scene& scene, std::size_t robot) {
    const LearnedModel* const learned = learnedModel(scene.modelOf(robot));
    return learned == nullptr ? nullptr : learned->motion().familiar();
}

MotionInput drivingNow(const Scenario& scenario, const WorldState& state, std::size_t robot) {
    const Twist& velocity_B = state.robots[robot].velocity_B;
    MotionInput now;
    now.commands = scenario.commandsOf(state, robot);
    now.start = scenario.scene().timeOf(state.tick);
    now.velocity = {velocity_B.x, velocity_B.rotation};
    return now;
}

}  // namespace mrose
