#include "identification/actuator_limits_fit.h"

#include <gtest/gtest.h>

#include "identification/driven_log.h"
#include "identification/recipes.h"
#include "motion/kinematic.h"
#include "synthetic/reference_robot.h"

namespace mrose {
namespace {

/// A robot whose wheels have a largest speed, and that is otherwise as one without.
class CutModel final : public MotionModel {
public:
    CutModel(const KinematicParameters& parameters, const ActuatorLimits& limits)
        : model_(parameters, 20 * ms), limits_(limits) {}
    Nanoseconds period() const override { return model_.period(); }
    Nanoseconds lookBack() const override { return model_.lookBack(); }
    void predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const override {
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            CommandHistory cut;
            const CommandView& asked = inputs[i].commands;
            for (std::size_t k = 0; k < asked.size() && asked.issueTime(k) <= inputs[i].start; ++k)
                cut.issue(asked.issueTime(k), limits_.withinWheelSpeed(asked.command(k)));
            MotionInput input = inputs[i];
            input.commands = cut;
            steps[i] = model_.predictOne(input);
        }
    }

private:
    KinematicModel model_;
    ActuatorLimits limits_;
};

using Channel = KinematicParameters::Channel;

ActuatorLimits foundOf(const MotionModel& model, const Channel& v, const Channel& w) {
    const std::vector<Log> logs{drivenLog(model, 6, 60, 3)};
    const ResponseTimes times{v.deadTime, v.lag, w.deadTime, w.lag, v.lag, w.lag, {}};
    return identifyActuatorLimits(logs, stateBlueprint(RobotTraits(), {"1"}, times));
}
ActuatorLimits found(const Channel& v, const Channel& w) { return foundOf(KinematicModel({v, w}, 20 * ms), v, w); }

TEST(ActuatorLimitsFit, FindsTheLargestAccelerations) {
    const ActuatorLimits limits = found({0.2, 0, 0.9, 0, 0, 0.5}, {0.25, 0, 1, 0, 0, 3});
    EXPECT_NEAR(limits.accelerationV, 0.5 / 0.9, 0.03);  // of the command, which the gain makes less of
    EXPECT_NEAR(limits.accelerationW, 3, 0.15);
    EXPECT_EQ(limits.wheelSpeed, 0);
}

TEST(ActuatorLimitsFit, TellsALagFromALimit) {
    EXPECT_EQ(found({0.2, 0.15, 1, 0, 0, 0}, {0.2, 0.1, 1, 0, 0, 0}), ActuatorLimits{});
    EXPECT_EQ(found({0.2, 0.6, 1, 0, 0, 0}, {0.2, 0.6, 1, 0, 0, 0}), ActuatorLimits{});
}

TEST(ActuatorLimitsFit, OneChannelMayBeLimitedAlone) {
    const ActuatorLimits limits = found({0.2, 0, 1, 0, 0, 0}, {0.2, 0, 1, 0, 0, 2});
    EXPECT_EQ(limits.accelerationV, 0);
    EXPECT_NEAR(limits.accelerationW, 2, 0.1);
}

TEST(ActuatorLimitsFit, FindsHowFastAWheelTurns) {
    const Channel v{0.2, 0.1, 1, 0, 0, 0}, w{0.2, 0.1, 1, 0, 0, 0};
    ActuatorLimits planted;
    planted.wheelSpeed = 0.45;
    planted.halfTrack = 0.17;
    const ActuatorLimits limits = foundOf(CutModel({v, w}, planted), v, w);
    EXPECT_NEAR(limits.wheelSpeed, 0.45, 0.03);
    EXPECT_NEAR(limits.halfTrack, 0.17, 0.02);
    EXPECT_FALSE(limits.ramps());
}

/// Which is of another class: its loops overshoot, its tyres scrub in bends, and its commands are late each by its own
/// time.
TEST(ActuatorLimitsFit, FindsThoseOfTheReferenceRobot) {
    const Log log = drivenReference(10, 60, 5);
    const ResponseTimes times{0.37, 0.44, 0.39, 0.04, 0.44, 0.04, {}};
    const ActuatorLimits limits =
        identifyActuatorLimits({&log, 1}, stateBlueprint(RobotTraits(), {"reference"}, times));
    const ReferenceRobotParameters truth;
    EXPECT_NEAR(limits.accelerationV / truth.acceleration, 1, 0.1);
    EXPECT_NEAR(limits.accelerationW / truth.turnAcceleration, 1, 0.1);
    EXPECT_NEAR(limits.wheelSpeed / truth.largestWheelSpeed, 1, 0.02);
    EXPECT_NEAR(limits.halfTrack / (truth.track / 2), 1, 0.05);
    EXPECT_NEAR(limits.longestRamp, 2 * truth.largestSpeed / limits.accelerationV, 0.05);  // turns are there sooner
}

TEST(ActuatorLimitsFit, LogsThatNeverTurnOrHaveNoTruthShowNone) {
    const Log driven = drivenLog(KinematicModel({{0, 0, 1, 0, 0, 0.5}, {0, 0, 1, 0, 0, 2}}, 20 * ms), 2, 30, 3);
    const MotionNetwork blueprint = stateBlueprint(RobotTraits(), {"1"}, {});
    EXPECT_TRUE(identifyActuatorLimits({&driven, 1}, blueprint).ramps());
    Log straight = driven, blind = driven;
    for (Trajectory& trajectory : straight.robots[0].trajectories)
        for (StampedCommand& issued : trajectory.commands) issued.command.w = 0;
    for (Trajectory& trajectory : blind.robots[0].trajectories) trajectory.poses.clear();
    EXPECT_EQ(identifyActuatorLimits({&straight, 1}, blueprint), ActuatorLimits{});
    EXPECT_EQ(identifyActuatorLimits({&blind, 1}, blueprint), ActuatorLimits{});
    EXPECT_EQ(identifyActuatorLimits({}, blueprint), ActuatorLimits{});
}

}  // namespace
}  // namespace mrose
