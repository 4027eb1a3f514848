#pragma once

#include "physics/contact_solver.h"
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
    std::vector<std::uint32_t> cluster;  ///< of each body
    std::vector<bool> solves;            ///< by cluster: whether the solver is asked
    /// Two bodies, or a body and an obstacle's piece, that may touch.
    struct ClusterPair {
        std::uint32_t cluster = 0, a = 0, b = 0;
        bool grounded = false;
    };
    std::vector<ClusterPair> pairs;
    std::vector<std::uint32_t> touching, place;  ///< bodies of a cluster; by body, where it is among them
    ContactCluster contacts;
    ContactSolver solver;
    std::vector<ContactOutcome> outcomes;
    struct Moved {
        std::uint32_t body = 0;
        ContactOutcome outcome;
    };
    std::vector<Moved> moved;              ///< whom contact takes off their plan
    std::vector<std::uint32_t> outranged;  ///< bodies that it sends farther than the search knew
    std::vector<ContactImpulse> impulses;
    std::vector<ContactReport> reports;  ///< where somebody asks for them
};

// The stages of a tick, in their order; step() says what they do together.

void decide(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers, const Overrides& overrides,
            StepTrace* trace);
void rememberPoses(const Scenario& scenario, WorldState& state);
void predictMotion(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers, StepTrace* trace);
/// When a kick acts that a robot's controller commands at this tick.
Nanoseconds kickDue(const Scene& scene, const WorldState& state, std::uint32_t robot, const Kick& kick);
void kick(const Scenario& scenario, WorldState& state, StepTrace* trace);
void planFreeMotion(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers);
void resolveContacts(const Scenario& scenario, WorldState& state, StepBuffers::Content& buffers, StepTrace* trace);
void countGoals(const Scenario& scenario, WorldState& state, const StepBuffers::Content& buffers, StepTrace* trace);

}  // namespace mrose
