#include "simulation/step.h"

#include "simulation/step_stages.h"

namespace mrose {

StepBuffers::StepBuffers() : content_(std::make_unique<Content>()) {}
StepBuffers::~StepBuffers() = default;
StepBuffers::StepBuffers(StepBuffers&&) noexcept = default;
StepBuffers& StepBuffers::operator=(StepBuffers&&) noexcept = default;

void StepTrace::clear(std::size_t robotCount, std::size_t objectCount) {
    robots.resize(robotCount);
    for (Robot& robot : robots) {
        robot.decided = robot.observed = robot.touched = false;
        robot.decision.clear();
        robot.unread.clearReadings();
    }
    touchedObjects.assign(objectCount, false);
    contacts.clear();
    orderedKicks.clear();
    kicks.clear();
    goals.clear();
    faults.clear();
    transmissions.clear();
    messages.clear();
}

void step(const Scenario& scenario, WorldState& state, StepBuffers& buffers, const Overrides& overrides,
          StepTrace* trace) {
    StepBuffers::Content& content = buffers.content();
    if (trace != nullptr) trace->clear(state.robots.size(), state.objects.size());
    decide(scenario, state, content, overrides, trace);
    rememberPoses(scenario, state);
    predictMotion(scenario, state, content, trace);
    kick(scenario, state, trace);
    planFreeMotion(scenario, state, content);
    resolveContacts(scenario, state, content, trace);
    countGoals(scenario, state, content, trace);
    ++state.tick;
}

WorldState stepped(const Scenario& scenario, WorldState state, const Overrides& overrides, StepTrace* trace) {
    StepBuffers buffers;
    step(scenario, state, buffers, overrides, trace);
    return state;
}

}  // namespace mrose
