#include "quantities/moment.h"

#include <optional>
#include <utility>

namespace mrose {
namespace {

/// Of a reading the newest; nullopt: none is known.
std::optional<SeenBodiesView> newest(const RobotInsight& insight, const ReadingName& name) {
    if (insight.observed)
        if (const Reading* const reading = insight.observation.newest(name))
            return SeenBodiesView{name, reading->measured, insight.observation.records<SeenBody>(reading)};
    for (const SeenBodies& before : insight.seenBefore)
        if (before.reading == name) return SeenBodiesView{name, before.measured, before.bodies};
    return std::nullopt;
}

/// Visits the readings of bodies that a robot's sensors give.
template <class Visit>
void visitKinds(const Scenario& scenario, std::size_t robot, Visit visit) {
    for (const SensorPointer& sensor : scenario.sensors(robot))
        for (const ReadingKind& kind : sensor->gives())
            if (*kind.type == recordType<SeenBody>()) visit(*sensor, kind.name);
}

/// What is not in the observation that follows on `insight`, of sensors that do not measure at each control instant.
std::vector<SeenBodies> seenBefore(const Scenario& scenario, std::size_t robot, const RobotInsight& insight,
                                   const StepTrace::Robot& now) {
    std::vector<SeenBodies> seen;
    visitKinds(scenario, robot, [&](const Sensor& sensor, const ReadingName& name) {
        if (sensor.period() == 0 || (now.observed && now.observation.find(name) != nullptr)) return;
        if (const auto last = newest(insight, name))
            seen.push_back({name, last->measured, {last->bodies.begin(), last->bodies.end()}});
    });
    return seen;
}

}  // namespace

std::vector<SeenBodiesView> newestSeen(const Scenario& scenario, std::size_t robot, const RobotInsight& insight) {
    std::vector<SeenBodiesView> seen;
    visitKinds(scenario, robot, [&](const Sensor&, const ReadingName& name) {
        if (const auto last = newest(insight, name)) seen.push_back(*last);
    });
    return seen;
}

void noteInsights(const Scenario& scenario, const StepTrace& trace, std::int64_t tick,
                  const std::vector<std::byte>& memoryBefore, std::vector<RobotInsight>& insights) {
    for (std::size_t robot = 0; robot < trace.robots.size(); ++robot) {
        const StepTrace::Robot& of = trace.robots[robot];
        if (!of.decided) continue;
        const auto before = scenario.memoryOf(memoryBefore, robot);
        std::vector<SeenBodies> seen = seenBefore(scenario, robot, insights[robot], of);
        insights[robot] = {tick - 1,       of.observed,  of.observation,
                           of.decision,    of.predicted, {before.begin(), before.end()},
                           std::move(seen)};
    }
}

}  // namespace mrose
