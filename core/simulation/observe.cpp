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

/// What a robot's sensors are given in common at its control instant; sets what an observation says of that.
SensorView viewOf(const Scenario& scenario, const WorldState& state, std::size_t robot, SensingBuffers& buffers,
                  Observation& out) {
    const Scene& scene = scenario.scene();
    const SensorView view{
        scene, scenario.obstacles(), scenario.past(), state, static_cast<std::uint32_t>(robot), buffers, 0};
    out.robot = view.robot;
    out.manipulators = static_cast<std::uint32_t>(scene.typeOf(robot).manipulators.size());
    out.time = view.timeBefore(0);
    out.noise = noiseBits(view.key(NoiseChannel::controller, 0));
    out.clearReadings();
    return view;
}

/// What arrives of one of them, as far as `view` wants it.
void senseAll(const Scenario& scenario, SensorView& view, std::uint32_t place, std::span<std::byte> memory,
              Observation& out) {
    const Sensor& sensor = *scenario.sensors(view.robot)[place];
    view.sensor = place;
    view.sinceLast = scenario.periodOf(view.robot).seconds;
    view.measured = out.time - sensor.latency();
    if (sensor.period() == 0) return sensor.sense(view, memory, out);
    // Where its period was a longer one before, the past reaches back no further than this one.
    const std::int64_t last =
        std::max(view.state.robots[view.robot].lastControl, view.state.tick - scenario.periodOf(view.robot).ticks);
    senseByItsClock(sensor, view, last, memory, out);
}

}  // namespace

void observe(const Scenario& scenario, const WorldState& state, std::size_t robot, std::span<std::byte> memory,
             SensingBuffers& buffers, Observation& out) {
    SensorView view = viewOf(scenario, state, robot, buffers, out);
    const std::size_t sensors = scenario.sensors(robot).size();
    for (std::uint32_t k = 0; k < sensors; ++k) {
        view.wanted = scenario.wanted(robot, k);
        senseAll(scenario, view, k, scenario.partOf(memory, robot, k), out);
    }
    if (!state.messages.empty() && scenario.readsMessages(robot)) receive(scenario, view, out);
}

void observeUnread(const Scenario& scenario, const WorldState& state, std::size_t robot, bool asked,
                   SensingBuffers& buffers, Observation& out) {
    SensorView view = viewOf(scenario, state, robot, buffers, out);
    const std::size_t sensors = scenario.sensors(robot).size();
    const std::size_t own = scenario.scene().typeOf(robot).sensors.size();
    std::vector<std::byte> memory;
    for (auto k = static_cast<std::uint32_t>(sensors - own); k < sensors; ++k) {
        const std::size_t gives = scenario.sensors(robot)[k]->gives().size();
        view.wanted = ~(asked ? scenario.wanted(robot, k) : 0u) & static_cast<std::uint32_t>((1ull << gives) - 1);
        if (view.wanted == 0) continue;
        const std::span<const std::byte> before = scenario.sensorMemory(state, robot, k);
        memory.assign(before.begin(), before.end());
        senseAll(scenario, view, k, memory, out);
    }
}

}  // namespace mrose
