#include "simulation/observe.h"

#include <algorithm>

#include "sensing/sensor_view.h"

namespace mrose {
namespace {

constexpr double onlyInRange = 1;

/// Lets a sensor with a clock of its own measure whatever arrives after tick `last`.
void senseByItsClock(const Sensor& sensor, SensorView view, std::int64_t last, std::span<std::byte> memory,
                     Observation& out) {
    const Nanoseconds period = sensor.period(), length = view.scene.tickLength;
    const bool exact = sensor.exact();
    const std::int64_t lag = exact ? 0 : view.lagOf(sensor.latency());
    // The nearest tick, or that of an exact one's arrival; also before the start.
    const Nanoseconds ahead = exact ? sensor.latency() + length - 1 : length / 2;
    const auto tickOf = [&](std::int64_t count) {
        const Nanoseconds later = count * period + ahead;
        return later / length - (later % length < 0 ? 1 : 0);
    };
    // Before the start all stood still where it starts.
    const std::int64_t now = view.state.tick - lag, before = last - lag;
    view.sinceLast = toSeconds(std::max(period, view.scene.tickLength));
    std::int64_t count = (view.scene.timeOf(before) - (exact ? sensor.latency() : 0)) / period;
    while (tickOf(count) > before) --count;
    while (tickOf(count) <= before) ++count;
    // At most one a tick: the draws of a measurement are its tick's.
    for (std::int64_t measured = before; tickOf(count) <= now; ++count) {
        if (tickOf(count) == measured) continue;
        measured = tickOf(count);
        view.arrivedAgo = now - measured;
        view.measured = count * period;
        sensor.sense(view, memory, out);
    }
}

/// What has arrived since the robot's last control instant; what is sent now arrives at the next one at the earliest.
void receive(const Scenario& scenario, const SensorView& view, Observation& out) {
    for (const Transmission& sent :
         view.buffers.radio.due(view.scene, scenario.teams(), view.state, view.robot, onlyInRange)) {
        if (sent.outcome != Transmission::Outcome::received) continue;
        const SentMessage& m = view.state.messages[sent.message];
        view.buffers.received.push_back({view.scene.timeOf(m.tick), m.from, m.kind, m.size, m.bytes});
    }
    if (view.buffers.received.empty()) return;
    out.add(messagesReading, view.timeBefore(0), std::span<const ReceivedMessage>(view.buffers.received));
    view.buffers.received.clear();
}

}  // namespace

void observe(const Scenario& scenario, const WorldState& state, std::size_t robot, std::span<std::byte> memory,
             SensingBuffers& buffers, Observation& out) {
    const Scene& scene = scenario.scene();
    SensorView view{scene, scenario.obstacles(), scenario.past(), state, static_cast<std::uint32_t>(robot), buffers, 0};
    out.robot = view.robot;
    out.manipulators = static_cast<std::uint32_t>(scene.typeOf(robot).manipulators.size());
    out.time = view.timeBefore(0);
    out.noise = noiseBits(view.key(NoiseChannel::controller, 0));
    out.clearReadings();
    const auto sensors = scenario.sensors(robot);
    // Where its period was a longer one before, the past reaches back no further than this one.
    const std::int64_t last = std::max(state.robots[robot].lastControl, state.tick - scenario.periodOf(robot).ticks);
    for (std::uint32_t k = 0; k < sensors.size(); ++k) {
        const Sensor& sensor = *sensors[k];
        view.sensor = k;
        view.wanted = scenario.wanted(robot, k);
        view.sinceLast = scenario.periodOf(robot).seconds;
        view.measured = out.time - sensor.latency();
        const std::span<std::byte> own = scenario.partOf(memory, robot, k);
        if (sensor.period() == 0)
            sensor.sense(view, own, out);
        else
            senseByItsClock(sensor, view, last, own, out);
    }
    if (!state.messages.empty() && scenario.readsMessages(robot)) receive(scenario, view, out);
}

}  // namespace mrose
