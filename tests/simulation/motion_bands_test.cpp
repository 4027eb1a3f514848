#include "simulation/motion_bands.h"

#include <gtest/gtest.h>

#include "motion/learned_model.h"
#include "motion/motion_network.h"
#include "motion/noisy_model.h"
#include "simulation/small_world.h"
#include "support/places.h"

namespace mrose {
namespace {

std::shared_ptr<const LearnedModel> createModel(MotionDraw draw) {
    static const auto motion =
        std::make_shared<const LearnedMotion>(*loadNetwork(sourceFolder() / "nets" / "create.net"));
    return std::make_shared<const LearnedModel>(motion, "1", draw);
}

/// A Create whose noise is learned, a robot with noise of its own, and one without any.
SmallWorld threeKinds(MotionDraw draw) {
    SmallWorld world;
    const auto told = std::make_shared<const Told>(
        std::vector<StampedCommand>{{0, {0.2, 0.3}}, {2 * nanosecondsPerSecond, {0.1, -0.6}}});
    world.robot(discRobot(), {0, 0, 0.5}, told, createModel(draw));
    world.robot(discRobot(), {5, 0, 0}, told, withNoise(ideal(), {0.1, 0.05, 0.02}));
    world.robot(discRobot(), {0, 5, 0}, told, ideal());
    return world;
}

using Samples = std::vector<std::vector<Pose>>;  ///< by instant

/// What step() makes of a state with those seeds, written down once more.
Samples sampledAlone(const Scenario& scenario, const WorldState& start, std::size_t robot, const Overrides& overrides,
                     const MotionSampler::Options& options) {
    Samples samples(static_cast<std::size_t>(options.ahead / options.step) + 1);
    for (int seed = 0; seed < options.samples; ++seed) {
        WorldState state = start;
        state.seed = static_cast<std::uint64_t>(seed);
        for (std::vector<Pose>& instant : samples) {
            instant.push_back(state.robots[robot].pose);
            for (int tick = 0; tick < 5; ++tick) state = stepped(scenario, std::move(state), overrides);
        }
    }
    return samples;
}

constexpr MotionSampler::Options fewSamples{nanosecondsPerSecond, 10};

TEST(MotionBands, AreThoseOfRunsWithOtherSeeds) {
    const auto scenario = std::make_shared<const Scenario>(threeKinds(MotionDraw::noisy).scenario());
    WorldState now = scenario->initialState(7);
    run(*scenario, now, 57);
    for (const bool decides : {false, true}) {
        const MotionSampler sampler(scenario, std::vector<bool>(3, decides));
        EXPECT_EQ(&sampler.drawn(), scenario.get());
        const auto bands = sampler.bands(now, fewSamples, [] { return true; });
        ASSERT_TRUE(bands);
        EXPECT_EQ(bands->tick, 57);
        EXPECT_EQ(bands->last(), 57 + 50);
        const Overrides overrides{{}, decides};
        for (const std::size_t robot : {0u, 1u}) {
            const Samples samples = sampledAlone(*scenario, now, robot, overrides, fewSamples);
            WorldState itself = now;
            ASSERT_EQ(bands->regions[robot].size(), samples.size());
            for (std::size_t instant = 0; instant < samples.size(); ++instant) {
                EXPECT_EQ(bands->regions[robot][instant], regionOf(samples[instant], itself.robots[robot].pose));
                for (int tick = 0; tick < 5; ++tick) itself = stepped(*scenario, std::move(itself), overrides);
            }
        }
    }
}

TEST(MotionBands, OfTheMeanAreThoseOfRunsThatDrawTheNoise) {
    const auto mean = std::make_shared<const Scenario>(threeKinds(MotionDraw::mean).scenario());
    const Scenario noisy = threeKinds(MotionDraw::noisy).scenario();
    const MotionSampler sampler(mean, {});
    const auto bands = sampler.bands(mean->initialState(), fewSamples, [] { return true; });
    ASSERT_TRUE(bands);
    const Samples samples = sampledAlone(noisy, noisy.initialState(), 0, {{}, false}, fewSamples);
    WorldState itself = mean->initialState();
    for (std::size_t instant = 0; instant < samples.size(); ++instant) {
        EXPECT_EQ(bands->regions[0][instant], regionOf(samples[instant], itself.robots[0].pose)) << instant;
        for (int tick = 0; tick < 5; ++tick) itself = stepped(*mean, std::move(itself), {{}, false});
    }
}

TEST(MotionBands, OneThatDecidesGoesOnDecidingAndTheOthersHoldTheirCommands) {
    const auto scenario = std::make_shared<const Scenario>(threeKinds(MotionDraw::noisy).scenario());
    WorldState now = scenario->initialState();
    run(*scenario, now, 97);  // another command comes at tick 100
    const auto of = [&](std::vector<bool> deciding) {
        return *MotionSampler(scenario, std::move(deciding)).bands(now, fewSamples, [] { return true; });
    };
    const MotionBands one = of({true, false, false}), all = of({true, true, true}), none = of({});
    EXPECT_EQ(one.regions[0], all.regions[0]);
    EXPECT_EQ(one.regions[1], none.regions[1]);
    EXPECT_NE(one.regions[0], none.regions[0]);
    EXPECT_NE(one.regions[1], all.regions[1]);
}

TEST(MotionBands, ARobotWithoutNoiseHasNone) {
    const MotionSampler sampler(std::make_shared<const Scenario>(threeKinds(MotionDraw::mean).scenario()), {});
    EXPECT_TRUE(sampler.knowsNoise(0));
    EXPECT_TRUE(sampler.knowsNoise(1));
    EXPECT_FALSE(sampler.knowsNoise(2));
    const auto bands =
        sampler.bands(threeKinds(MotionDraw::mean).scenario().initialState(), fewSamples, [] { return true; });
    EXPECT_TRUE(bands->regions[2].empty());
    EXPECT_EQ(bands->at(2, 0), nullptr);
    SmallWorld exact;
    exact.robot(discRobot(), {}, std::make_shared<const Told>(Command{0.2, 0}), ideal());
    EXPECT_FALSE(MotionSampler(std::make_shared<const Scenario>(exact.scenario()), {}).knowsAnyNoise());
}

TEST(MotionBands, TheirInstantsAreFoundByTicks) {
    MotionBands bands{100, 5, {{}, {}}};
    EXPECT_TRUE(bands.empty());
    for (int i = 0; i < 4; ++i) bands.regions[1].push_back(regionOf(std::vector<Pose>{{double(i), 0, 0}}, {}));
    EXPECT_EQ(bands.last(), 115);
    EXPECT_EQ(bands.at(1, 99), nullptr);
    EXPECT_EQ(bands.at(1, 104)->centre.x, 0);
    EXPECT_EQ(bands.at(1, 119)->centre.x, 3);
    EXPECT_EQ(bands.at(1, 120), nullptr);
    EXPECT_EQ(bands.between(1, 107, 112).size(), 2u);
    EXPECT_EQ(bands.between(1, 0, 1000).size(), 4u);
    EXPECT_TRUE(bands.between(1, 0, 99).empty());
    EXPECT_TRUE(bands.between(1, 130, 140).empty());
    EXPECT_TRUE(bands.between(0, 100, 115).empty());
}

TEST(MotionBands, EndWhereTheyAreWantedNoMore) {
    const MotionSampler sampler(std::make_shared<const Scenario>(threeKinds(MotionDraw::mean).scenario()), {});
    int asked = 0;
    EXPECT_FALSE(sampler.bands(threeKinds(MotionDraw::mean).scenario().initialState(), fewSamples,
                               [&] { return ++asked < 20; }));
    EXPECT_EQ(asked, 20);
}

}  // namespace
}  // namespace mrose
