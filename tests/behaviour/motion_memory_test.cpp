#include "behaviour/motion_memory.h"

#include <gtest/gtest.h>

#include "behaviour/small_field.h"
#include "support/observation_parts.h"
#include "support/units.h"

namespace mrose {
namespace {

void expectNear(const Pose& a, const Pose& b, double tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.heading, b.heading, tolerance);
}

void observeAt(MotionMemory& memory, Nanoseconds time, const Velocity& velocity) {
    ObservationParts observation;
    observation.time = time;
    observation.velocity = velocity;
    memory.observe(observation);
}

TEST(MotionMemory, MotionSinceIsTheArcOfASteadyVelocity) {
    MotionMemory memory{};
    for (int i = 0; i < 6; ++i) observeAt(memory, i * 100 * ms, {0.4, 0.7});
    expectNear(memory.motionSince(500 * ms), {}, 0);
    expectNear(memory.motionSince(270 * ms), exp({0.23 * 0.4, 0, 0.23 * 0.7}), 1e-15);
    expectNear(memory.motionSince(-1000 * ms), exp({0.5 * 0.4, 0, 0.5 * 0.7}), 1e-15);
}

TEST(MotionMemory, MotionSinceIntegratesChangingVelocity) {
    MotionMemory memory{};
    for (int i = 0; i < 8; ++i) observeAt(memory, i * 100 * ms, {0.1 * i, 0});
    EXPECT_NEAR(memory.motionSince(200 * ms).x, (0.49 - 0.04) / 2, 1e-15);
}

/// The drive that answers late and otherwise does what it is told is an independent computation of it.
TEST(MotionMemory, MotionDuringDeadTimeIsWhereADrivesCommandsLead) {
    KinematicParameters parameters;
    parameters.v.deadTime = parameters.w.deadTime = 0.33;
    const KinematicModel model(parameters);
    MotionMemory memory{};
    CommandHistory history;
    for (int i = 0; i < 7; ++i) {
        observeAt(memory, i * 100 * ms, {});
        const Command told{0.1 * i, 0.9 - 0.3 * i};
        memory.issue(told);
        history.issue(i * 100 * ms, told);
    }
    // What is told at 600 ms takes effect at 930 ms.
    Pose expected;
    for (int i = 0; i < 3; ++i) expected = expected * model.predictOne({&history, (600 + 100 * i) * ms, {}}).increment;
    const KinematicModel rest(parameters, 30 * ms);
    expected = expected * rest.predictOne({&history, 900 * ms, {}}).increment;
    observeAt(memory, 600 * ms, {});
    expectNear(memory.motionDuring(0.33), expected, 1e-14);
}

TEST(MotionMemory, RemembersTheLatestCommands) {
    MotionMemory memory{};
    EXPECT_EQ(memory.commandAt(0), Command{});
    for (int i = 0; i < 40; ++i) {
        observeAt(memory, i * 100 * ms, {});
        memory.issue({1.0 * i, 0});
    }
    observeAt(memory, 4000 * ms, {});
    EXPECT_EQ(memory.commandAt(4000 * ms).v, 39);  // still in force
    memory.issue({40, 0});
    EXPECT_EQ(memory.commandAt(4000 * ms).v, 40);
    EXPECT_EQ(memory.commandAt(3900 * ms).v, 39);
    EXPECT_EQ(memory.commandAt(3899 * ms).v, 38);
    EXPECT_EQ(memory.commandAt(2950 * ms).v, 29);
    EXPECT_EQ(memory.commandAt(0).v, 29);
}

}  // namespace
}  // namespace mrose
