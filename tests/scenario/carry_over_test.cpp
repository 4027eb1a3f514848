#include "scenario/carry_over.h"

#include <gtest/gtest.h>

#include "motion/kinematic.h"
#include "recording/playback.h"
#include "scenario/controller_file.h"
#include "scenario/descriptions.h"
#include "sensing/self_localisation.h"
#include "simulation/step.h"
#include "support/shipped.h"
#include "world/state_difference.h"

namespace mrose {
namespace {

constexpr std::int64_t carriedAt = 500;

WorldState stateAt(const Scenario& scenario, std::int64_t tick) {
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    while (state.tick < tick) step(scenario, state, buffers);
    return state;
}

std::shared_ptr<const MotionModel> slowModel(Nanoseconds period = 100'000'000) {
    KinematicParameters parameters;
    parameters.v = {0.2, 0.1, 1, 0, 0.3, 0};
    parameters.w = {0.2, 0.1, 1, 0, 1, 0};
    return std::make_shared<const KinematicModel>(parameters, period);
}

class CarriedOver : public testing::Test {
protected:
    /// Robots 1 ... 4 are learned, 5 ... 8 kinematic.
    static Scenario soccer() { return shippedScenario("soccer"); }
    static ScenarioParts partsWith(const std::function<void(ScenarioParts&)>& change) {
        ScenarioParts parts = soccer().parts();
        change(parts);
        return parts;
    }
    static void giveModel(ScenarioParts& parts, std::size_t robot, std::shared_ptr<const MotionModel> model) {
        parts.scene.robots[robot].model = static_cast<std::uint32_t>(parts.scene.models.size());
        parts.scene.models.push_back(std::move(model));
    }

    Scenario from = soccer();
    WorldState state = stateAt(from, carriedAt);
};

TEST_F(CarriedOver, TheSameScenarioLoadedAgainGoesOnTheSame) {
    const Scenario again = soccer();
    ASSERT_NE(&again.scene().modelOf(0), &from.scene().modelOf(0));
    WorldState carried = carriedOver(from, state, again);
    const auto difference = firstDifference(state, carried);
    ASSERT_FALSE(difference) << difference->message();
    StepBuffers buffers;
    for (int i = 0; i < 1000; ++i) {
        step(from, state, buffers);
        step(again, carried, buffers);
        ASSERT_EQ(hashOf(state), hashOf(carried)) << state.tick;
    }
    EXPECT_EQ(carriedOver(again, carried, from).contacts.size(), state.contacts.size());
    EXPECT_FALSE(firstDifference(carriedOver(again, carried, from), state));
}

/// Whether its motion model remembers a period.
bool begun(const Scenario& scenario, const WorldState& state, std::size_t robot) {
    const auto memory = scenario.motionMemory(state, robot);
    return !memory.empty() && as<LearnedMotion::Memory>(memory).begun != 0;
}

/// Its next prediction is the other model's from the same commands, and nothing is said of what it would be
/// unperturbed.
TEST_F(CarriedOver, SwappedModelsGoOnFromTheSameCommands) {
    const std::shared_ptr<const MotionModel> learned = from.parts().scene.models[from.scene().robots[0].model];
    const Scenario to(partsWith([&](ScenarioParts& parts) {
        giveModel(parts, 1, slowModel());
        giveModel(parts, 5, learned);
    }));
    WorldState carried = carriedOver(from, state, to);
    ASSERT_EQ(validate(to, carried), "");
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(carried.robots[i].pose, state.robots[i].pose);
        EXPECT_EQ(carried.robots[i].velocity_B, state.robots[i].velocity_B);
        EXPECT_EQ(carried.robots[i].nextControl, state.robots[i].nextControl);
        EXPECT_EQ(begun(to, carried, i), begun(from, state, i) && i != 1 && i != 5) << i;
        const CommandView then = from.commandsOf(state, i), now = to.commandsOf(carried, i);
        const Nanoseconds time = from.scene().timeOf(state.tick);
        const Nanoseconds back = std::min(from.scene().modelOf(i).lookBack(), to.scene().modelOf(i).lookBack());
        for (Nanoseconds age = 0; age <= back; age += 5'000'000) EXPECT_EQ(now.at(time - age), then.at(time - age));
    }
    EXPECT_FALSE(firstDifference(carriedOver(to, carried, to), carried));
    StepBuffers buffers;
    StepTrace trace;
    for (const std::size_t robot : {1, 5}) {
        WorldState next = carried;
        while (next.tick < carried.robots[robot].nextControl) step(to, next, buffers);
        const WorldState at = next;
        step(to, next, buffers, {}, &trace);
        const MotionStep expected = to.scene().modelOf(robot).predictOne(
            {to.commandsOf(next, robot), to.scene().timeOf(at.tick),
             Velocity{at.robots[robot].velocity_B.x, at.robots[robot].velocity_B.rotation}});
        EXPECT_EQ(trace.robots[robot].predicted.velocity, expected.velocity);
    }
    // Back again at the same instant nothing is lost but what was unperturbed, and commands that the others do not
    // read.
    const WorldState back = carriedOver(to, carried, from);
    EXPECT_EQ(validate(from, back), "");
    EXPECT_EQ(back.memory, state.memory);
    EXPECT_FALSE(begun(from, back, 1));
    EXPECT_TRUE(begun(from, back, 2));
}

TEST_F(CarriedOver, AnotherPeriodDecidesAtOnce) {
    const Scenario to(partsWith([&](ScenarioParts& parts) { giveModel(parts, 4, slowModel(60'000'000)); }));
    WorldState carried = carriedOver(from, state, to);
    ASSERT_EQ(validate(to, carried), "");
    EXPECT_EQ(carried.robots[4].nextControl, carriedAt);
    EXPECT_EQ(carried.robots[3].nextControl, state.robots[3].nextControl);
    StepBuffers buffers;
    StepTrace trace;
    step(to, carried, buffers, {}, &trace);
    EXPECT_TRUE(trace.robots[4].decided);
    EXPECT_EQ(carried.robots[4].nextControl, carriedAt + 3);
    for (int i = 0; i < 300; ++i) {
        step(to, carried, buffers, {}, &trace);
        EXPECT_TRUE(trace.faults.empty());
    }
}

TEST_F(CarriedOver, OtherControllersStartAndTheOthersRemember) {
    // Robot 2 chases the ball, robot 4 wanders; both are told otherwise, robot 3 is told the same anew.
    const Scenario again = soccer();
    const Scenario to(partsWith([&](ScenarioParts& parts) {
        parts.controllers[1] = again.parts().controllers[3];
        parts.controllers[2] = again.parts().controllers[2];
        parts.controllers[3] = noController();
    }));
    const WorldState carried = carriedOver(from, state, to), start = to.initialState();
    ASSERT_EQ(validate(to, carried), "");
    const auto memory = [](const Scenario& scenario, const WorldState& of, std::size_t robot) {
        const auto bytes = scenario.memoryOf(of, robot);
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    };
    EXPECT_EQ(memory(to, carried, 1), memory(to, start, 1));
    EXPECT_EQ(memory(to, carried, 2), memory(from, state, 2));
    EXPECT_NE(memory(to, carried, 2), memory(to, start, 2));
    EXPECT_EQ(memory(to, carried, 7), memory(from, state, 7));
}

TEST_F(CarriedOver, BodiesAreMatchedByTheirNames) {
    // Red 1 goes, blue 3 gets another name, the others change places, and there is one more object.
    const Scenario to(partsWith([](ScenarioParts& parts) {
        std::vector<SceneRobot>& robots = parts.scene.robots;
        robots.erase(robots.begin());
        parts.controllers.erase(parts.controllers.begin());
        std::swap(robots[0], robots[5]);
        std::swap(parts.controllers[0], parts.controllers[5]);
        robots[0].name = "a stranger";
        parts.scene.objects.push_back(parts.scene.objects[0]);
        parts.scene.objects.back().name = "second ball";
        parts.scene.objects.back().start = {1, 2.5, 0};
    }));
    ASSERT_EQ(from.scene().robots[6].name, "blue 3");
    state.kicks = {{state.tick * 20'000'000 + 1, 0, 0, 0.5}, {state.tick * 20'000'000 + 2, 3, 0, 0.75}};
    state.contacts = {{0, 0, 2, 0, 7, 1, 2}, {1, 0, 8, 0, 8, 3, 4}, {7, 0, noBody, 5, 9, 5, 6}};
    state.robots[3].ready[0] = 123;
    const WorldState carried = carriedOver(from, state, to);
    ASSERT_EQ(validate(to, carried), "");
    ASSERT_EQ(carried.robots.size(), 7u);
    const std::vector<std::size_t> origins{99, 2, 3, 4, 5, 1, 7};
    for (std::size_t i = 1; i < 7; ++i) {
        EXPECT_EQ(to.scene().robots[i].name, from.scene().robots[origins[i]].name);
        EXPECT_EQ(carried.robots[i].pose, state.robots[origins[i]].pose) << i;
        EXPECT_TRUE(std::ranges::equal(to.sensorMemory(carried, i), from.sensorMemory(state, origins[i]))) << i;
        for (const std::int64_t lag : {1, 3, 5})
            EXPECT_EQ(to.poseBefore(carried, i, lag), from.poseBefore(state, origins[i], lag));
    }
    EXPECT_EQ(carried.robots[0].pose, to.scene().robots[0].start);
    EXPECT_EQ(carried.robots[0].nextControl, carriedAt);
    EXPECT_EQ(to.poseBefore(carried, 0, 2), to.scene().robots[0].start);
    EXPECT_EQ(carried.objects[0].pose, state.objects[0].pose);
    EXPECT_EQ(carried.objects[0].velocity_W, state.objects[0].velocity_W);
    EXPECT_EQ(carried.objects[1].pose, (Pose{1, 2.5, 0}));
    EXPECT_EQ(carried.goals, state.goals);
    ASSERT_EQ(carried.kicks.size(), 1u);
    EXPECT_EQ(carried.kicks[0].robot, 2u);
    EXPECT_EQ(carried.kicks[0].power, 0.75);
    EXPECT_EQ(carried.robots[2].ready[0], 123);
    // Of robots 1 and 3 one is gone; 2 and the ball are 6 and 8 now, 8 and the wall 7.
    ASSERT_EQ(carried.contacts.size(), 2u);
    EXPECT_EQ(carried.contacts[0].bodyA, 5u);
    EXPECT_EQ(carried.contacts[0].bodyB, 7u);
    EXPECT_EQ(carried.contacts[0].feature, 8u);
    EXPECT_EQ(carried.contacts[1].bodyA, 6u);
    EXPECT_EQ(carried.contacts[1].bodyB, noBody);
    WorldState further = carried;
    StepBuffers buffers;
    for (int i = 0; i < 200; ++i) step(to, further, buffers);
    EXPECT_EQ(validate(to, further), "");
}

/// Others come between them, and one is gone: what a sensor remembers goes with its name.
TEST_F(CarriedOver, SensorsAreMatchedByTheirNames) {
    const auto localiser = [](const char* name) {
        SelfLocalisation options;
        options.bias = {0.1, 0.1, 0.1};
        return std::make_shared<const SelfLocaliser>(options, SensorTraits{name, 0});
    };
    const auto with = [&](const std::vector<const char*>& names) {
        return Scenario(partsWith([&](ScenarioParts& parts) {
            for (RobotType& type : parts.scene.robotTypes)
                for (const char* name : names) type.sensors.push_back(localiser(name));
        }));
    };
    const Scenario before = with({"gone", "gps", "odd"}), after = with({"odd", "gps"});
    const WorldState old = stateAt(before, carriedAt);
    const WorldState carried = carriedOver(before, old, after);
    ASSERT_EQ(validate(after, carried), "");
    for (std::size_t i = 0; i < 8; ++i) {
        const auto own = [&](std::size_t sensor) { return after.sensorMemory(carried, i, sensor); };
        EXPECT_TRUE(std::ranges::equal(own(0), before.sensorMemory(old, i, 0)));
        EXPECT_TRUE(std::ranges::equal(own(3), before.sensorMemory(old, i, 5)));
        EXPECT_TRUE(std::ranges::equal(own(4), before.sensorMemory(old, i, 4)));
    }
    const WorldState back = carriedOver(after, carried, before);
    EXPECT_EQ(as<SelfLocaliser::Memory>(before.sensorMemory(back, 0, 3)).localised, 0u) << "it is new";
}

TEST_F(CarriedOver, GoalsAndKickersAreMatchedByTheirNamesToo) {
    const Scenario to(partsWith([](ScenarioParts& parts) {
        std::reverse(parts.scene.environment.goals.begin(), parts.scene.environment.goals.end());
        parts.scene.environment.goals.push_back({"new", {{0, 0}, {1, 0}, {1, 1}}});
        for (RobotType& type : parts.scene.robotTypes) {
            Manipulator other;
            other.name = "other";
            type.manipulators.insert(type.manipulators.begin(), other);
        }
    }));
    state.goals = {3, 5};
    state.robots[2].ready[0] = 77;
    state.kicks = {{state.tick * 20'000'000, 2, 0, 1}};
    const WorldState carried = carriedOver(from, state, to);
    EXPECT_EQ(carried.goals, (std::vector<std::int32_t>{5, 3, 0}));
    EXPECT_EQ(carried.robots[2].ready[0], 0);
    EXPECT_EQ(carried.robots[2].ready[1], 77);
    EXPECT_EQ(carried.kicks.at(0).manipulator, 1u);
}

/// With another tick length it is the same instant, or the next at which there is a tick.
TEST_F(CarriedOver, AnotherClockKeepsTheTime) {
    for (const auto& [length, tick] : {std::pair<Nanoseconds, std::int64_t>{10'000'000, 1002}, {50'000'000, 201}}) {
        const Scenario to(partsWith([&, l = length](ScenarioParts& parts) {
            parts.scene.tickLength = l;
            for (SceneRobot& robot : parts.scene.robots) robot.phase = 0;
        }));
        WorldState odd = state;
        StepBuffers buffers;
        step(from, odd, buffers);
        WorldState carried = carriedOver(from, odd, to);
        ASSERT_EQ(validate(to, carried), "");
        EXPECT_EQ(carried.tick, tick);
        for (const RobotState& robot : carried.robots) EXPECT_EQ(robot.nextControl, tick);
        const std::int64_t lag = 100'000'000 / length;
        EXPECT_EQ(to.poseBefore(carried, 3, lag), from.poseBefore(odd, 3, 5));
        for (int i = 0; i < 100; ++i) step(to, carried, buffers);
        EXPECT_EQ(validate(to, carried), "");
    }
}

}  // namespace
}  // namespace mrose
