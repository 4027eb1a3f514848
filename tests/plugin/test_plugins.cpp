#include "plugin/test_plugins.h"

#include "io/format.h"
#include "support/places.h"

namespace mrose {

std::string testPlugin(const std::string& name) { return std::string(MROSE_TEST_PLUGINS) + '/' + name + ".so"; }

std::string how(const std::string& what, double after) {
    return "how = \"" + what + "\"\nafter_s = " + numberText(after) + '\n';
}

IsolationOptions isolation(double limit) { return {{mroseProgram(), "plugin-host"}, limit, 60}; }

Scenario drivenBy(std::vector<std::shared_ptr<const Controller>> controllers) {
    SmallWorld world;
    RobotType type = squareRobot();
    type.perception.robots.present = type.perception.objects.present = true;
    type.manipulators.resize(1);
    double y = 0;
    for (const auto& controller : controllers) world.robot(type, {0, y += 2, 0}, controller, ideal());
    world.object(ballType(), {1, 1, 0}, {0.5, 0.1, 0});
    return world.scenario();
}

std::vector<StepTrace::Fault> faultsOfRun(const Scenario& scenario, WorldState& state, int ticks) {
    StepBuffers buffers;
    StepTrace trace;
    std::vector<StepTrace::Fault> faults;
    for (int i = 0; i < ticks; ++i) {
        step(scenario, state, buffers, {}, &trace);
        faults.insert(faults.end(), trace.faults.begin(), trace.faults.end());
    }
    return faults;
}

}  // namespace mrose
