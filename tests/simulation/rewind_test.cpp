// A state is all there is: whoever keeps one can go back to it, branch from it, replay to it, to the last bit.

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "motion/learned_model.h"
#include "motion/noisy_model.h"
#include "simulation/small_world.h"
#include "support/places.h"
#include "support/units.h"
#include "world/noise.h"
#include "world/state_bytes.h"
#include "world/state_difference.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

/// Remembers how often it was asked, and drives by that.
class Counting final : public Controller {
public:
    std::size_t memorySize() const override { return 16; }
    void start(std::span<std::byte> memory) const override { as<std::int64_t>(memory) = 3; }
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override {
        const std::int64_t count = ++as<std::int64_t>(memory);
        const NoisePair u = uniformPair({9, count, observation.robot, 0});
        decision.command = Command{u.first, 6 * u.second - 3};
        if (count % 3 == 0) decision.kicks.push_back({0, u.first});
        // What it believes enters what it does.
        if (observation.localised() && observation.self().x < 2) decision.command->w += 0.1;
    }
};

std::string difference(const WorldState& a, const WorldState& b) {
    const auto first = firstDifference(a, b);
    return first ? first->message() : "none";
}

std::shared_ptr<const Shape> horseshoe() {
    ShapePart part;
    part.polygon = {{-0.2, -0.2}, {0.3, -0.2}, {0.3, -0.1}, {0.1, -0.1},
                    {0.1, 0.1},   {0.3, 0.1},  {0.3, 0.2},  {-0.2, 0.2}};
    return std::make_shared<const Shape>(Shape::fromParts("horseshoe", {part}));
}

/// All kinds of models, shapes and laws in a field so small that they keep colliding.
Scenario crowd(std::size_t robots = 9) {
    SmallWorld world(walledField(4, 4));
    world.parts().scene.randomFactor = 0.3;
    KinematicParameters lagged;
    lagged.v = {0.13, 0.2, 0.9, 0, 0.8, 1.5};
    lagged.w = {0.07, 0.1, 1.1, 0, 3, 8};
    const auto network = loadNetwork(sourceFolder() / "nets" / "create.net");
    EXPECT_TRUE(network);
    const auto learned = std::make_shared<const LearnedMotion>(*network);
    const std::vector<std::shared_ptr<const MotionModel>> models{
        ideal(), paperFormModel(), std::make_shared<const KinematicModel>(lagged, 200 * ms),
        std::make_shared<const LearnedModel>(learned, "2"), std::make_shared<const KinematicModel>(lagged, 40 * ms)};
    const MotionNoise noise{0.05, 0.05, 0.05};
    for (std::size_t i = 0; i < robots; ++i) {
        RobotType type = i % 3 == 0 ? squareRobot(0.4) : discRobot(0.2);
        if (i % 3 == 2) type.shape = horseshoe();
        type.manipulators = {{"kicker", {0.2, 0}}};
        type.perception.self = {{0.05, 0.05, 0.02}, {0.1, 0.1, 0.05}, 1.5, 90 * ms, 0.1, 0.01, 0.5};
        const double column = static_cast<double>(i % 3), row = static_cast<double>(i / 3);
        world.robot(type, {0.7 + 1.2 * column, 0.7 + 1.2 * row, 1.0 * static_cast<double>(i)},
                    std::make_shared<const Counting>(), withNoise(models[i % models.size()], noise),
                    static_cast<std::int64_t>(i) % 5);
    }
    world.object(ballType(), {1.3, 1.3, 0}, {0.5, 0.3, 1}).object(boxType(), {2.5, 1.3, 0.4});
    return world.scenario();
}

TEST(Rewind, RestoredStateStepsToSameBitsFromEveryTick) {
    const Scenario scenario = crowd();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    std::size_t touching = 0;
    for (int k = 0; k < 3000; ++k) {
        const std::string saved = stateBytes(state);
        step(scenario, state, buffers);
        auto restored = parseState(saved, "saved");
        ASSERT_TRUE(restored) << restored.error().message();
        const WorldState again = stepped(scenario, std::move(*restored));
        ASSERT_TRUE(stateBytes(again) == stateBytes(state)) << "tick " << k << ": " << difference(again, state);
        touching += state.contacts.size();
    }
    EXPECT_GT(touching, 3000u);
}

TEST(Rewind, BuffersThatServedAnotherWorldChangeNothing) {
    // The other world's ball is so fast that its ticks are solved in several steps.
    SmallWorld thrown(walledField(2, 2));
    thrown.object(ballType(), {1, 1, 0}, {18, 3, 0}).object(boxType(), {1.5, 1.1, 0});
    const Scenario other = thrown.scenario(), scenario = crowd();
    WorldState state = scenario.initialState(), beside = scenario.initialState();
    StepBuffers shared, own;
    std::size_t bounced = 0;
    for (int k = 0; k < 500; ++k) {
        WorldState fast = other.initialState();
        for (int i = 0; i < 3; ++i) step(other, fast, shared);
        bounced += fast.objects[0].velocity_W.x < 0 ? 1 : 0;
        step(scenario, state, shared);
        step(scenario, beside, own);
        ASSERT_EQ(difference(state, beside), "none") << "tick " << k;
    }
    EXPECT_EQ(bounced, 500u);
}

std::vector<StateHash> hashesOfRun(const Scenario& scenario, WorldState state, int ticks, bool traced = false) {
    std::vector<StateHash> hashes;
    StepBuffers buffers;
    StepTrace trace;
    for (int k = 0; k < ticks; ++k) {
        step(scenario, state, buffers, {}, traced ? &trace : nullptr);
        hashes.push_back(hashOf(state));
    }
    return hashes;
}

TEST(Rewind, ReplayFromTheDecisionsAloneGivesTheSameWorld) {
    const Scenario scenario = crowd();
    WorldState state = scenario.initialState(), replayed = state;
    StepBuffers buffers;
    for (int k = 0; k < 2000; ++k) {
        StepTrace trace;
        step(scenario, state, buffers, {}, &trace);
        std::vector<RobotDecision> decisions;
        for (std::uint32_t i = 0; i < trace.robots.size(); ++i)
            if (trace.robots[i].decided) decisions.push_back({i, trace.robots[i].decision});
        step(scenario, replayed, buffers, {decisions, false});
        ASSERT_EQ(hashOf(replayed).world, hashOf(state).world) << "tick " << k << ": " << difference(replayed, state);
    }
}

TEST(Rewind, BranchLeavesItsTrunkAsItWas) {
    const Scenario scenario = crowd();
    const std::vector<StateHash> straight = hashesOfRun(scenario, scenario.initialState(), 800);
    WorldState state = scenario.initialState();
    run(scenario, state, 400);
    WorldState branch = state;
    const RobotDecision other{0, {Command{-0.5, 0.3}}};
    StepBuffers buffers;
    for (int k = 0; k < 400; ++k) step(scenario, branch, buffers, {{&other, 1}});
    EXPECT_NE(hashOf(branch), straight.back());
    run(scenario, state, 400);
    EXPECT_EQ(hashOf(state), straight.back());
}

TEST(Rewind, SameBitsWithAndWithoutTraceAndOnAnyNumberOfThreads) {
    const Scenario scenario = crowd();
    const std::vector<StateHash> alone = hashesOfRun(scenario, scenario.initialState(7), 500);
    EXPECT_EQ(hashesOfRun(scenario, scenario.initialState(7), 500, true), alone);
    std::vector<std::vector<StateHash>> together(16);
    tbb::parallel_for(std::size_t{0}, together.size(), [&](std::size_t i) {
        together[i] = hashesOfRun(scenario, scenario.initialState(i % 2 == 0 ? 7 : 8), 500);
    });
    for (std::size_t i = 0; i < together.size(); ++i) EXPECT_EQ(together[i] == alone, i % 2 == 0) << i;
}

TEST(Rewind, OtherRobotsNoiseDoesNotDependOnHowManyThereAre) {
    // Far apart robots do not affect each other: a robot's motion is the same with and without them.
    const auto lonely = [](std::size_t robots) {
        SmallWorld world;
        const auto noisy = withNoise(ideal(), {0.05, 0.05, 0.05});
        for (std::size_t i = 0; i < robots; ++i)
            world.robot(squareRobot(), {100.0 * static_cast<double>(i), 0, 0}, std::make_shared<const Counting>(),
                        noisy);
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState();
        run(scenario, state, 300);
        return state.robots[0].pose;
    };
    EXPECT_EQ(lonely(1), lonely(30));
}

}  // namespace
}  // namespace mrose
