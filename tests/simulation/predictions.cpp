#include "simulation/predictions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "simulation/step.h"

namespace mrose {
namespace {

struct Foreseen {
    Pose end;
    bool near = false;
};

/// Whether another body or a wall is within 5 mm.
bool hasNeighbour(const Scenario& scenario, const WorldState& state, std::size_t body) {
    constexpr double nearer = 0.005;
    const auto piecesOf = [&](std::size_t i) {
        std::vector<ConvexPiece> pieces;
        for (const ConvexPiece& piece : scenario.scene().shapeOf(i).pieces)
            pieces.push_back(placed(piece, Placement(Scenario::poseOf(state, i))));
        return pieces;
    };
    const auto own = piecesOf(body);
    const auto near = [&](const std::vector<ConvexPiece>& others) {
        return std::any_of(own.begin(), own.end(), [&](const ConvexPiece& a) {
            return std::any_of(others.begin(), others.end(),
                               [&](const ConvexPiece& b) { return distance(a, b) < nearer; });
        });
    };
    if (near(scenario.obstacles().pieces())) return true;
    for (std::size_t other = 0; other < scenario.scene().bodyCount(); ++other)
        if (other != body && near(piecesOf(other))) return true;
    return false;
}

/// Asked for the period that begins at `state`; what the robot is told at its first instant is in the state `after` it.
Foreseen foreseen(const Scenario& scenario, const WorldState& state, const WorldState& after, std::size_t robot) {
    const RobotState& r = state.robots[robot];
    MotionInput input{scenario.commandsOf(after, robot),
                      scenario.scene().timeOf(state.tick),
                      {r.velocity_B.x, r.velocity_B.rotation}};
    const std::span<const std::byte> kept = scenario.motionMemory(state, robot);
    std::vector<std::byte> memory(kept.begin(), kept.end());
    input.memory = memory;
    return {r.pose * scenario.scene().modelOf(robot).predictOne(input).increment, hasNeighbour(scenario, state, robot)};
}

bool pressed(const StepTrace& trace, std::size_t robot) {
    return std::any_of(trace.contacts.begin(), trace.contacts.end(),
                       [&](const ContactReport& c) { return c.bodyA == robot || c.bodyB == robot; });
}

}  // namespace

FreePeriods expectPredictions(const Scenario& scenario, int ticks, double tolerance) {
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    std::vector<std::optional<Foreseen>> expected(state.robots.size());
    FreePeriods found;
    for (int k = 0; k < ticks; ++k) {
        const WorldState before = state;
        StepTrace trace;
        step(scenario, state, buffers, {}, &trace);
        for (std::size_t i = 0; i < state.robots.size(); ++i) {
            const RobotState& r = before.robots[i];
            if (r.nextControl == before.tick) {
                if (expected[i]) {
                    EXPECT_NEAR(r.pose.x, expected[i]->end.x, tolerance) << i;
                    EXPECT_NEAR(r.pose.y, expected[i]->end.y, tolerance) << i;
                    EXPECT_NEAR(r.pose.heading, expected[i]->end.heading, tolerance) << i;
                    ++found.compared;
                    found.near += expected[i]->near ? 1 : 0;
                }
                // What was pushed before is on its way back to what its model says.
                expected[i].reset();
                if (!r.pushed) expected[i] = foreseen(scenario, before, state, i);
            }
            if (expected[i] && pressed(trace, i)) {
                expected[i].reset();
                ++found.touched;
            }
        }
    }
    return found;
}

}  // namespace mrose
