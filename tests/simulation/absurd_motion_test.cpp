#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "motion/learned_model.h"
#include "simulation/running_into.h"
#include "world/absurd_command.h"
#include "world/state_difference.h"

// Commands and predictions that are finite and cannot be meant: the robot stands, and the run goes on.

namespace mrose {
namespace {

constexpr double most = absurdSpeed;

/// A robot told so between others, in a walled field.
Scenario amongOthers(const Command& command, std::shared_ptr<const MotionModel> model = ideal()) {
    SmallWorld world(walledField(20, 10));
    world.robot(squareRobot(), {3, 5, 0}, std::make_shared<const Told>(Command{0.4, 0.3}), ideal());
    world.robot(squareRobot(), {10, 5, 1}, std::make_shared<const Told>(command), std::move(model));
    world.robot(squareRobot(), {15, 5, 0}, std::make_shared<const Told>(Command{-0.3, 0.3}), ideal());
    return world.object(ballType(), {12, 2, 0}, {0.5, 0.1, 0}).scenario();
}

/// Its faults over a run in which it stands and all else does what it does beside a robot that is told to stand.
std::vector<std::string> faultsOf(const Scenario& scenario) {
    const Scenario standing = amongOthers({});
    WorldState state = scenario.initialState(), expected = standing.initialState();
    StepBuffers buffers;
    std::vector<std::string> faults;
    for (int i = 0; i < 100; ++i) {
        StepTrace trace;
        step(scenario, state, buffers, {}, &trace);
        step(standing, expected, buffers);
        for (const StepTrace::Fault& fault : trace.faults) {
            EXPECT_EQ(fault.robot, 1u);
            faults.push_back(fault.what);
        }
    }
    EXPECT_TRUE(finite(state));
    EXPECT_EQ(state.robots[1].pose, (Pose{10, 5, 1}));
    for (const std::size_t other : {0, 2}) EXPECT_EQ(state.robots[other].pose, expected.robots[other].pose);
    EXPECT_EQ(state.objects[0].pose, expected.objects[0].pose);
    return faults;
}

void expectFaults(const Scenario& scenario, const std::string& what) {
    const std::vector<std::string> faults = faultsOf(scenario);
    EXPECT_EQ(faults.size(), 20u) << "one in each of its periods";
    for (const std::string& fault : faults) EXPECT_EQ(fault, what);
}

TEST(AbsurdMotion, CommandIsAFaultOfItsController) {
    const std::string gave = "its controller gave a command ";
    expectFaults(amongOthers({1e160, 0}), gave + "of 1e+160 m/s; expected at most 1000 m/s");
    expectFaults(amongOthers({-1000.5, 0}), gave + "of -1000.5 m/s; expected at most 1000 m/s");
    expectFaults(amongOthers({0, 1e200}), gave + "of 1e+200 rad/s; expected at most 1000 rad/s");
    expectFaults(amongOthers({1, -std::numeric_limits<double>::max()}),
                 gave + "of -1.7976931348623157e+308 rad/s; expected at most 1000 rad/s");
    expectFaults(amongOthers({0, std::nan("")}), gave + "that is not finite");
}

TEST(AbsurdMotion, DecisionFromOutsideIsTakenNoOtherwise) {
    const Scenario scenario = amongOthers({0.5, 0});
    for (const bool earlier : {false, true}) {
        RobotDecision decision{1, {}};
        if (earlier)
            decision.decision.earlier = {{0, {0, 1e200}}};
        else
            decision.decision.command = Command{0, 1e200};
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        StepTrace trace;
        step(scenario, state, buffers, {std::span(&decision, 1), true}, &trace);
        ASSERT_EQ(trace.faults.size(), 1u);
        EXPECT_EQ(trace.faults[0].what, "its controller gave a command of 1e+200 rad/s; expected at most 1000 rad/s");
        EXPECT_EQ(state.robots[1].pose, (Pose{10, 5, 1}));
        run(scenario, state, 50);
        EXPECT_GT(state.robots[1].velocity_B.x, 0.4) << "its controller is asked again";
    }
}

/// What a robot can do, it does, and comes to no harm at the walls.
TEST(AbsurdMotion, FastestCommandsAreObeyed) {
    const auto far = [](const Command& command) {
        SmallWorld world;
        world.robot(squareRobot(), {}, std::make_shared<const Told>(command), ideal());
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        StepTrace trace;
        for (int i = 0; i < 50; ++i) {
            step(scenario, state, buffers, {}, &trace);
            EXPECT_TRUE(trace.faults.empty());
        }
        return state.robots[0].pose;
    };
    EXPECT_NEAR(far({most, 0}).x, most, 1e-6);
    EXPECT_NEAR(far({0, -most}).heading, -most, 1e-6);
    for (const Command& command : {Command{most, 0}, Command{0, most}, Command{-most, most}}) {
        const Scenario scenario = amongOthers(command);
        WorldState state = scenario.initialState();
        run(scenario, state, 50);
        EXPECT_TRUE(finite(state));
    }
}

/// Predicts one thing, in its period.
class Predicts final : public MotionModel {
public:
    Predicts(const MotionStep& step, Nanoseconds period) : step_(step), period_(period) {}
    Nanoseconds period() const override { return period_; }
    Nanoseconds lookBack() const override { return 0; }
    void predict(std::span<const MotionInput> /*inputs*/, std::span<MotionStep> steps) const override {
        std::fill(steps.begin(), steps.end(), step_);
    }

private:
    MotionStep step_;
    Nanoseconds period_;
};

/// However long the period, no farther than the fastest come in it.
TEST(AbsurdMotion, PredictionIsAFaultOfItsModel) {
    const auto model = [](const MotionStep& step, Nanoseconds period = 100'000'000) {
        return amongOthers({}, std::make_shared<const Predicts>(step, period));
    };
    const std::string predicted = "its motion model predicted ", metres = " m/s; expected at most 1000 m/s",
                      radians = " rad/s; expected at most 1000 rad/s";
    expectFaults(model({{0, -150, 0}, {}}), predicted + "-1500.0" + metres);
    expectFaults(model({{0, 0, 1e199}, {}}), predicted + "1e+200" + radians);
    expectFaults(model({{}, {1e30, 0}}), predicted + "1e+30" + metres);
    expectFaults(model({{}, {0, -1001}}), predicted + "-1001.0" + radians);
    EXPECT_EQ(faultsOf(model({{30, 0, 0}, {}}, 20'000'000)).front(), predicted + "1500.0" + metres);
    const Scenario longer = model({{150, 0, 0}, {}}, 200'000'000);
    StepTrace trace;
    stepped(longer, longer.initialState(), {}, &trace);
    EXPECT_TRUE(trace.faults.empty());
}

TEST(AbsurdMotion, NetworkThatPredictsSoIsNamed) {
    using Quantity = NetworkInput::Quantity;
    MotionNetwork network;
    network.robotType = "r";
    network.robots = {"1"};
    network.inputs = {{Quantity::velocityV}, {Quantity::velocityW}};
    network.outputs.resize(5);
    network.outputs[0].mean = 1e30;
    network.mlp.shape = {2, 1, 5};
    network.mlp.parameters.resize(network.mlp.shape.parameterCount());
    const auto model = std::make_shared<const LearnedModel>(std::make_shared<const LearnedMotion>(network), "1");
    for (const std::string& fault : faultsOf(amongOthers({0.5, 0}, model)))
        EXPECT_TRUE(fault.starts_with("its motion model predicted 1e+31 m/s") ||
                    fault.starts_with("its motion model predicted 9.99"))
            << fault;
    EXPECT_EQ(faultsOf(amongOthers({0.5, 0}, model)).size(), 20u);
}

}  // namespace
}  // namespace mrose
