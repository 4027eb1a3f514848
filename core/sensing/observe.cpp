#include "sensing/observe.h"

#include "sensing/body_sight.h"
#include "sensing/self_localisation.h"

namespace mrose {
namespace {

Velocity odometry(const Observer& observer) {
    const Twist& velocity_B = observer.state.robots[observer.robot].velocity_B;
    const Perception& perception = observer.perception();
    if (perception.velocityNoise == 0 && perception.rotationNoise == 0) return {velocity_B.x, velocity_B.rotation};
    const NoisePair draw = normalPair(observer.key(NoiseChannel::velocity));
    return {velocity_B.x + perception.velocityNoise * draw.first,
            velocity_B.rotation + perception.rotationNoise * draw.second};
}

}  // namespace

void observe(const Scenario& scenario, const WorldState& state, std::size_t robot, SensorMemory& memory,
             SensingBuffers& buffers, Observation& out) {
    const Observer observer{scenario, state, static_cast<std::uint32_t>(robot), buffers};
    driftBiases(observer, memory);
    localise(observer, memory);
    out.robot = observer.robot;
    out.manipulators = static_cast<std::uint32_t>(scenario.scene().typeOf(robot).manipulators.size());
    out.time = observer.timeBefore(0);
    out.noise = noiseBits(observer.key(NoiseChannel::controller));
    out.localised = memory.localised != 0;
    out.self = memory.self;
    out.selfMeasured = memory.selfMeasured;
    out.velocity = odometry(observer);
    out.robots.clear();
    out.objects.clear();
    const Attention attention = scenario.controller(robot).attention();
    if (attention.robots) seeRobots(observer, memory.bearingBias, out.robots);
    if (attention.objects) seeObjects(observer, memory.bearingBias, out.objects);
}

}  // namespace mrose
