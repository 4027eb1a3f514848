#include "sensing/observe.h"

namespace mrose {

void observe(const Scenario& scenario, const WorldState& state, std::size_t robot, SensorMemory& memory,
             Observation& out) {
    const RobotState& self = state.robots[robot];
    memory.self = self.pose;
    memory.selfMeasured = scenario.scene().timeOf(state.tick);
    memory.localised = true;
    out.robot = static_cast<std::uint32_t>(robot);
    out.time = scenario.scene().timeOf(state.tick);
    out.localised = true;
    out.self = self.pose;
    out.selfMeasured = memory.selfMeasured;
    out.velocity = {self.velocity_B.x, self.velocity_B.rotation};
    const Placement frame(self.pose);
    out.robots.clear();
    out.objects.clear();
    for (std::uint32_t i = 0; i < state.robots.size(); ++i)
        if (i != robot) out.robots.push_back({i, frame.placeBack(position(state.robots[i].pose)), out.time});
    for (std::uint32_t i = 0; i < state.objects.size(); ++i)
        out.objects.push_back({i, frame.placeBack(position(state.objects[i].pose)), out.time});
}

}  // namespace mrose
