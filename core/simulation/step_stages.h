#pragma once

#include "sensing/sensing_buffers.h"
#include "simulation/motion_path.h"
#include "simulation/step.h"
#include "simulation/touch_search.h"

namespace mrose {

struct StepBuffers::Content {
    std::vector<std::uint32_t> due;  ///< robots whose control instant this is
    SensingBuffers sensing;
    Observation observation;
    Decision decision;
    std::vector<MotionInput> inputs;
    std::vector<MotionStep> predictions;
    std::vector<Recovery> paths;       ///< of the robots at the tick's end, without touch
    std::vector<ObjectState> objects;  ///< likewise
    std::vector<std::byte> motion;     ///< WorldState::motion at the tick's start, where objects remember
    std::vector<SweptBody> swept;
    TouchSearch search;
    std::vector<std::uint32_t> cluster, touching;
    std::vector<bool> meets;
    ContactTask task;
    ContactSolver solver;
    std::vector<ContactOutcome> outcomes;
    std::vector<ContactImpulse> impulses;
};

// The stages of a tick, in their order; step() says what they do together.

void decide(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers, const Overrides& overrides,
            StepTrace* trace);
void rememberPoses(const Scenario& scenario, WorldState& state);
void predictMotion(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers, StepTrace* trace);
void kick(const Scenario& scenario, WorldState& state, StepTrace* trace);
void planFreeMotion(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers);
void resolveContacts(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers, StepTrace* trace);
void countGoals(const Scenario& scenario, WorldState& state, const StepBuffers::Content& buffers, StepTrace* trace);

}  // namespace mrose
