#include "quantities/moment.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace mrose {
namespace {

constexpr Nanoseconds longestKnown = 2 * nanosecondsPerSecond;

/// Visits the readings that sensors give.
template <class Visit>
void visitKinds(std::span<const SensorPointer> sensors, Visit visit) {
    for (const SensorPointer& sensor : sensors)
        for (const ReadingKind& kind : sensor->gives()) visit(*sensor, kind.name);
}

/// The newest of a name; nullopt: none is known.
std::optional<NewestReading> newestReading(const Sensor& sensor, const ReadingName& name, const RobotInsight& insight) {
    const Reading* const now = insight.observed ? insight.observation.newest(name) : nullptr;
    if (now != nullptr) return NewestReading{&sensor, &insight.observation, now};
    const Reading* const other = insight.others.newest(name);
    if (other != nullptr) return NewestReading{&sensor, &insight.others, other};
    return std::nullopt;
}

/// What is known beside the observation that follows on `insight`.
Observation othersOf(const Scenario& scenario, std::size_t robot, const RobotInsight& insight, Nanoseconds time,
                     const StepTrace::Robot& now) {
    Observation others;
    others.robot = static_cast<std::uint32_t>(robot);
    const auto take = [&](const Observation& from, const Reading& reading) {
        std::byte* const place = others.add(reading.name, *reading.type, reading.measured, reading.count);
        if (reading.count > 0) std::memcpy(place, from.recordsOf(reading), reading.count * reading.type->size);
    };
    visitKinds(scenario.scene().typeOf(robot).sensors, [&](const Sensor& sensor, const ReadingName& name) {
        if (now.observed && now.observation.find(name) != nullptr) return;
        if (const Reading* const unread = now.unread.newest(name)) return take(now.unread, *unread);
        // One without a clock of its own would have given another.
        if (sensor.period() == 0) return;
        const auto last = newestReading(sensor, name, insight);
        if (last && time - last->reading->measured <= knownFor(scenario, robot, sensor))
            take(*last->of, *last->reading);
    });
    return others;
}

}  // namespace

Nanoseconds knownFor(const Scenario& scenario, std::size_t robot, const Sensor& sensor) {
    const Nanoseconds control = scenario.scene().modelOf(robot).period();
    return sensor.latency() + std::min(sensor.period() * 3 / 2, longestKnown) + control;
}

std::vector<NewestReading> newestReadings(const Moment& moment, std::size_t robot) {
    std::vector<NewestReading> newest;
    if (robot >= moment.insights.size()) return newest;
    visitKinds(moment.scenario->sensors(robot), [&](const Sensor& sensor, const ReadingName& name) {
        const auto known = newestReading(sensor, name, moment.insights[robot]);
        if (known && moment.now() - known->reading->measured <= knownFor(*moment.scenario, robot, sensor))
            newest.push_back(*known);
    });
    return newest;
}

void noteInsights(const Scenario& scenario, const StepTrace& trace, std::int64_t tick,
                  const std::vector<std::byte>& memoryBefore, std::vector<RobotInsight>& insights) {
    for (std::size_t robot = 0; robot < trace.robots.size(); ++robot) {
        const StepTrace::Robot& of = trace.robots[robot];
        if (!of.decided) continue;
        const auto before = scenario.memoryOf(memoryBefore, robot);
        const Nanoseconds time = scenario.scene().timeOf(tick - 1);
        Observation others = othersOf(scenario, robot, insights[robot], time, of);
        insights[robot] = {tick - 1,         of.observed,  of.observation,
                           of.decision,      of.predicted, {before.begin(), before.end()},
                           std::move(others)};
    }
}

}  // namespace mrose
