#include "simulation/run_statistics.h"

#include "control/learned_mapping.h"
#include "simulation/driving_now.h"

namespace mrose {

namespace {

/// nullopt: its controller does not say it.
std::optional<double> beyondOf(const Scenario& scenario, const WorldState& state, std::size_t robot) {
    MemoryEntries entries(beyondLearned);
    scenario.controller(robot).explain(scenario.memoryOf(state, robot), entries);
    return entries.complete() ? std::optional(entries.all().front().value) : std::nullopt;
}

}  // namespace

RunStatistics::RunStatistics(const Scenario& scenario, const WorldState& start, bool countsUnfamiliar,
                             bool countsBeyond)
    : goals(scenario.scene().environment.goals.size()),
      driven(scenario.scene().robots.size()),
      scenario_(&scenario),
      touchCounter_(scenario.scene().tickLength),
      isUnfamiliar_(scenario.scene().robots.size()),
      isBeyond_(scenario.scene().robots.size()) {
    for (const RobotState& robot : start.robots) places_.push_back(position(robot.pose));
    const Scene& scene = scenario.scene();
    for (std::size_t i = 0; i < scene.robots.size(); ++i)
        unfamiliar.push_back(countsUnfamiliar && familiarDriving(scene, i) != nullptr ? std::optional<std::int64_t>(0)
                                                                                      : std::nullopt);
    for (std::size_t i = 0; i < scene.robots.size(); ++i)
        beyond.push_back(countsBeyond && beyondOf(scenario, start, i) ? std::optional<std::int64_t>(0) : std::nullopt);
    while (ball_ < scene.objects.size() && !scene.typeOfObject(ball_).rolls) ++ball_;
}

void RunStatistics::add(const WorldState& after, const StepTrace& trace) {
    ++ticks;
    goals = after.goals;
    for (std::size_t i = 0; i < driven.size(); ++i) {
        const Point now = position(after.robots[i].pose);
        driven[i] += distance(places_[i], now);
        places_[i] = now;
    }
    addUnfamiliar(after, trace);
    addBeyond(after, trace);
    for (const StepTrace::Kicked& kicked : trace.kicks) {
        ++kicks;
        hits += kicked.hit ? 1 : 0;
    }
    faults += static_cast<std::int64_t>(trace.faults.size());
    if (firstFault.empty() && !trace.faults.empty())
        firstFault = bodyName(scenario_->scene(), trace.faults[0].robot) + ": " + trace.faults[0].what;
    touches += static_cast<std::int64_t>(touchCounter_.add(trace).size());
    if (ball_ < after.objects.size()) {
        const Twist& velocity = after.objects[ball_].velocity_W;
        if (length({velocity.x, velocity.y}) < still) ballStill += scenario_->scene().tickLength;
    }
}

void RunStatistics::addUnfamiliar(const WorldState& after, const StepTrace& trace) {
    bool any = false;
    for (std::size_t i = 0; i < unfamiliar.size(); ++i) {
        if (!unfamiliar[i]) continue;
        if (trace.robots[i].decided)
            isUnfamiliar_[i] = familiarDriving(scenario_->scene(), i)->isUnfamiliar(drivingNow(*scenario_, after, i));
        *unfamiliar[i] += isUnfamiliar_[i] ? 1 : 0;
        any = any || isUnfamiliar_[i];
    }
    anyUnfamiliar += any ? 1 : 0;
}

void RunStatistics::addBeyond(const WorldState& after, const StepTrace& trace) {
    for (std::size_t i = 0; i < beyond.size(); ++i) {
        if (!beyond[i]) continue;
        if (trace.robots[i].decided) isBeyond_[i] = beyondOf(*scenario_, after, i).value_or(0) > 0;
        *beyond[i] += isBeyond_[i] ? 1 : 0;
    }
}

std::string bodyName(const Scene& scene, std::size_t body) {
    if (body >= scene.robots.size()) return scene.objects[body - scene.robots.size()].name;
    const bool person = scene.typeOf(body).person;
    std::size_t number = 0;
    for (std::size_t i = 0; i <= body; ++i) number += scene.typeOf(i).person == person ? 1 : 0;
    return (person ? "person " : "robot ") + std::to_string(number) + " (" + scene.robots[body].name + ')';
}

}  // namespace mrose
