// A camera learned from logs, in the simulated world: with networks made by hand, of which is known what they report.
#include "sensing/learned_camera.h"

#include <cmath>

#include <gmock/gmock.h>

#include "geometry/normal_distribution.h"
#include "quantities/value_key.h"
#include "sensing/camera_network.h"
#include "sensing/camera_world.h"
#include "world/state_bytes.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

using testing::ElementsAre;

std::vector<std::uint32_t> indices(const std::vector<SeenBody>& seen) {
    std::vector<std::uint32_t> all;
    for (const SeenBody& body : seen) all.push_back(body.index);
    return all;
}

TEST(LearnedCamera, GivesLandmarksAndRobotsByTheirIndices) {
    const Scenario scenario =
        filmed(cameraOf(cameraNetwork()),
               {slab({0, 5}, {1, 6}, true), post("b", {2, 0.5}), post("", {1, -0.5}), post("a", {3, -1})},
               {{1, 0.9, 0}, {-1, 0, 0}, {2, -0.2, 0}})
            .scenario();
    for (const CameraLook& look : looks(scenario, 20)) {
        ASSERT_THAT(indices(look.landmarks), ElementsAre(0, 1));
        ASSERT_THAT(indices(look.robots), ElementsAre(1, 3));
        EXPECT_NEAR(distance(look.landmarks[0].position_B, {2, 0.5}), 0, 3e-4);
        EXPECT_NEAR(distance(look.landmarks[1].position_B, {3, -1}), 0, 3e-4);
        EXPECT_NEAR(distance(look.robots[0].position_B, {1, 0.9}), 0, 3e-4);
        EXPECT_EQ(look.robots[0].measured, look.measured);
    }
}

TEST(LearnedCamera, ALookAtWhichItReportsNothingGivesEmptyReadings) {
    const auto all = looks(filmed(cameraOf(cameraNetwork({.threshold = -8})), {post("a", {2, 0})}).scenario(), 10);
    for (const CameraLook& look : all) EXPECT_TRUE(look.landmarks.empty() && look.robots.empty());
    SensorNetwork landmarksAlone = cameraNetwork();
    landmarksAlone.robotSubjects = false;
    const SensorPointer camera = cameraOf(landmarksAlone);
    ASSERT_EQ(camera->gives().size(), 1u);
    EXPECT_EQ(camera->gives()[0].name, landmarksName);
}

TEST(LearnedCamera, ReportsTheShareAndTheErrorsOfItsDistribution) {
    const CameraReadings readings{0.5, 0.03, 0.1, -0.01, 0.02};
    const auto all = looks(filmed(cameraOf(cameraNetwork(readings)), {post("a", {2, 1})}).scenario(), 20000);
    const double range = std::hypot(2, 1), bearing = std::atan2(1, 2);
    int reported = 0;
    StandardNormals ranges, bearings;
    double products = 0;
    for (const CameraLook& look : all)
        for (const SeenBody& seen : look.landmarks) {
            ++reported;
            const double r = (length(seen.position_B) - range - 0.03) / 0.1;
            const double b = (direction(seen.position_B) - bearing + 0.01) / 0.02;
            ranges.add(r);
            bearings.add(b);
            products += r * b;
        }
    expectRate(reported, static_cast<int>(all.size()), normalProbability(0.5));
    ranges.expectStandard("range");
    bearings.expectStandard("bearing");
    EXPECT_NEAR(products / reported, 0, sigmas / std::sqrt(reported));
}

/// Neither its period nor, here, its latency are whole numbers of ticks.
TEST(LearnedCamera, ReportsWhatWasTrueItsLatencyAgoToTheNanosecond) {
    for (const Nanoseconds latency : {0 * millisecond, 33 * millisecond, 40 * millisecond, 57 * millisecond}) {
        const SensorPointer camera = cameraOf(cameraNetwork(), {std::nullopt, latency});
        Environment environment;
        environment.obstacles = {post("a", {1.5, 0}), post("b", {-1.5, 0}), post("c", {0, 1.5}), post("d", {0, -1.5})};
        const Scenario scenario =
            SmallWorld(std::move(environment))
                .robot(filming(camera), {0, 0, 0.3}, std::make_shared<const Told>(Command{0.1, 1}), ideal(), 2)
                .scenario();
        WorldState state = scenario.initialState(4);
        StepBuffers buffers;
        StepTrace trace;
        std::vector<Pose> poses;
        Nanoseconds before = -1000 * millisecond;
        int landmarks = 0;
        for (int k = 0; k < 600; ++k) {
            poses.push_back(state.robots[0].pose);
            const Nanoseconds now = scenario.scene().timeOf(state.tick);
            step(scenario, state, buffers, {}, &trace);
            if (!trace.robots[0].observed) continue;
            for (const CameraLook& look : looksOf(trace.robots[0].observation)) {
                EXPECT_EQ(look.measured % (236 * millisecond), 0);
                if (before >= 0) {
                    EXPECT_EQ(look.measured - before, 236 * millisecond) << "each look once";
                }
                before = look.measured;
                EXPECT_GE(now, look.measured + latency);
                EXPECT_LT(now, look.measured + latency + 120 * millisecond) << "it comes with the next observation";
                if (look.measured < 0) continue;
                const auto tick = static_cast<std::size_t>(look.measured / (20 * millisecond));
                const double share = static_cast<double>(look.measured % (20 * millisecond)) / (20.0 * millisecond);
                const Pose &from = poses[tick], to = tick + 1 < poses.size() ? poses[tick + 1] : from;
                const Placement eye(Pose{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y),
                                         from.heading + share * (to.heading - from.heading)});
                for (const SeenBody& seen : look.landmarks) {
                    const Point place = scenario.obstacles().landmarks()[seen.index].position;
                    EXPECT_NEAR(distance(seen.position_B, eye.placeBack(place)), 0, 3e-4) << look.measured;
                    ++landmarks;
                }
            }
        }
        EXPECT_GT(landmarks, 40);
        EXPECT_GE(before, 11'500 * millisecond);
    }
}

/// It turns at 1 rad/s: the detection goes by the true rotation, at the instant of the look.
TEST(LearnedCamera, KnowsItsRobotsVelocity) {
    for (const double sign : {-1.0, 1.0}) {
        SensorNetwork network = cameraNetworkBy(0);
        network.learned.inputs[0] = {"rotation", "rad/s", 0.99, 1};
        network.view.fieldOfView = 6;
        const Scenario scenario =
            SmallWorld([] {
                Environment environment;
                environment.obstacles = {post("a", {2, 0})};
                return environment;
            }())
                .robot(filming(cameraOf(network)), {}, std::make_shared<const Told>(Command{0, sign}), ideal())
                .scenario();
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        StepTrace trace;
        int seen = 0, all = 0;
        for (int k = 0; k < 300; ++k) {
            step(scenario, state, buffers, {}, &trace);
            if (k < 50 || !trace.robots[0].observed) continue;
            for (const CameraLook& look : looksOf(trace.robots[0].observation)) {
                ++all;
                seen += static_cast<int>(look.landmarks.size());
            }
        }
        EXPECT_GE(all, 20);
        if (sign > 0) {
            EXPECT_GT(seen, all - 4) << "but for those behind, at the view's open end";
        } else {
            EXPECT_EQ(seen, 0);
        }
    }
}

/// By the clearance: bodies hide what is behind them as far as the network says, and not what is before them.
TEST(LearnedCamera, BodiesHideByTheirShapes) {
    const SensorPointer camera = cameraOf(cameraNetworkBy(1));
    const auto seen = [&](const Pose& other) {
        return !looks(filmed(camera, {post("a", {2, 0})}, {other}).scenario(), 1)[0].landmarks.empty();
    };
    EXPECT_TRUE(seen({-1, 0, 0}));
    EXPECT_TRUE(seen({2.5, 0, 0}));
    EXPECT_FALSE(seen({1, 0, 0}));
    EXPECT_FALSE(seen({1, 0.16, 0}));
    EXPECT_TRUE(seen({1, 0.18, 0}));
    EXPECT_TRUE(seen({1, -0.18, 0}));
    const auto behindSquare = [&](const Pose& other) {
        SmallWorld world = filmed(camera, {post("a", {2, 0})});
        world.object(boxType(0.4), other);
        return looks(world.scenario(), 1)[0].landmarks.empty();
    };
    EXPECT_TRUE(behindSquare({1, 0.19, 0}));
    EXPECT_FALSE(behindSquare({1, 0.21, 0}));
    EXPECT_TRUE(behindSquare({1, 0.27, std::numbers::pi / 4})) << "its corner";
    EXPECT_FALSE(behindSquare({1, 0.29, std::numbers::pi / 4}));
}

/// Whatever its network says.
TEST(LearnedCamera, NothingIsReportedThroughWalls) {
    const SensorPointer camera = cameraOf(cameraNetwork());
    const auto seen = [&](const Obstacle& between) {
        const CameraLook look = looks(filmed(camera, {between, post("a", {2, 0})}, {{2, 1, 0}}).scenario(), 1)[0];
        return std::pair(!look.landmarks.empty(), !look.robots.empty());
    };
    using Seen = std::pair<bool, bool>;
    EXPECT_EQ(seen(slab({1, -2}, {1.05, 2}, true)), Seen(false, false));
    EXPECT_EQ(seen(slab({1, -0.02}, {1.05, 0.02}, true)), Seen(false, true)) << "a wall, however narrow";
    EXPECT_EQ(seen(slab({1, -0.02}, {1.05, 0.02}, false)), Seen(true, true)) << "as thin as a landmark";
    EXPECT_EQ(seen(slab({1, -0.3}, {1.05, 0.05}, false)), Seen(false, true)) << "wider than 0.3 m";
    EXPECT_EQ(seen(slab({3, -2}, {3.05, 2}, true)), Seen(true, true)) << "behind";
    EXPECT_EQ(seen(slab({1, 0.02}, {1.05, 0.4}, true)), Seen(true, true)) << "between the lines";
    EXPECT_EQ(seen(post("", {1, 0}, 0.2)), Seen(false, true));
    EXPECT_EQ(seen(post("", {1, 0}, 0.1)), Seen(true, true));
    EXPECT_EQ(seen(post("", {1, 0.3}, 0.2)), Seen(true, false));
}

TEST(LearnedCamera, SeesNothingBeyondTheMarginOfItsView) {
    const auto seen = [](const Point& place, const SensorNetwork& network) {
        return !looks(filmed(cameraOf(network), {post("a", place)}).scenario(), 1)[0].landmarks.empty();
    };
    const View margin = cameraNetwork().view.margin();
    EXPECT_TRUE(seen({margin.range - 0.01, 0}, cameraNetwork()));
    EXPECT_FALSE(seen({margin.range + 0.01, 0}, cameraNetwork()));
    for (const double side : {-0.5, 0.5}) {
        EXPECT_TRUE(seen(2 * towards(side * (margin.fieldOfView - 0.01)), cameraNetwork()));
        EXPECT_FALSE(seen(2 * towards(side * (margin.fieldOfView + 0.01)), cameraNetwork()));
    }
    SensorNetwork allRound = cameraNetwork();
    allRound.view.fieldOfView = 2 * std::numbers::pi;
    EXPECT_TRUE(seen({-2, 0}, allRound));
    EXPECT_TRUE(seen({-2, -1e-9}, allRound));
}

TEST(LearnedCamera, ErrorsAreAlikeWithinALookAndFromLookToLookAsLearned) {
    SensorNetwork network = cameraNetwork({.rangeSpread = 0.05});
    network.noise[1] = {0.2, 0.3, 2, 0.4, 0.7};  // the range's
    const auto all = looks(filmed(cameraOf(network), {post("a", {2, 0.6}), post("b", {2, -0.6})}).scenario(), 40000);
    const double range = std::hypot(2, 0.6), period = 0.236;
    const auto z = [&](const CameraLook& look, std::size_t i) {
        return (length(look.landmarks[i].position_B) - range) / 0.05;
    };
    StandardNormals errors;
    double together = 0, own = 0, other = 0, later = 0;
    const std::size_t lag = 5;
    for (std::size_t k = lag; k < all.size(); ++k) {
        errors.add(z(all[k], 0));
        together += z(all[k], 0) * z(all[k], 1);
        own += z(all[k], 0) * z(all[k - 1], 0);
        other += z(all[k], 0) * z(all[k - 1], 1);
        later += z(all[k], 0) * z(all[k - lag], 0);
    }
    const double n = errors.count, slow = 0.3 * std::exp(-period / 2), subject = 0.4 * std::exp(-period / 0.7);
    const double slowLater = 0.3 * std::exp(-5 * period / 2), subjectLater = 0.4 * std::exp(-5 * period / 0.7);
    // What lasts makes fewer draws of them.
    const double tolerance = sigmas * std::sqrt(2 / (n * period / (2 * 2.0)));
    EXPECT_NEAR(errors.sum / n, 0, tolerance);
    EXPECT_NEAR(errors.squares / n, 1, tolerance);
    EXPECT_NEAR(together / n, 0.2 + 0.3, tolerance);
    EXPECT_NEAR(own / n, slow + subject, tolerance);
    EXPECT_NEAR(other / n, slow, tolerance);
    EXPECT_NEAR(later / n, slowLater + subjectLater, tolerance);
}

/// A part of all readings' missing lasts: what is missing is missing for long.
TEST(LearnedCamera, ReadingsAreMissingTogetherWhereThatLasts) {
    SensorNetwork network = cameraNetwork({.threshold = 0});
    network.noise[0] = {0, 0, 1, 1, 50};
    const auto all = looks(filmed(cameraOf(network), {post("a", {2, 0})}).scenario(), 20000);
    int changes = 0, reported = 0;
    for (std::size_t k = 1; k < all.size(); ++k) {
        reported += static_cast<int>(all[k].landmarks.size());
        changes += all[k].landmarks.size() != all[k - 1].landmarks.size();
    }
    // Of normal numbers with correlation c, a share of arccos(c) / pi has other signs.
    const double share = std::acos(std::exp(-0.236 / 50)) / std::numbers::pi;
    EXPECT_NEAR(changes / 20000.0, share, 0.15 * share);
    EXPECT_NEAR(reported / 20000.0, 0.5, 0.25);
}

SensorNetwork noisyNetwork() {
    SensorNetwork network = cameraNetwork({0.8, 0.01, 0.1, 0.02, 0.05});
    for (std::size_t i = 0; i < 3; ++i) network.noise[i] = {0.2, 0.3, 2, 0.4, 0.7};
    network.gross = {0.05, {1, 0.5}};
    return network;
}

/// Several that drive about among landmarks.
SmallWorld driving(const std::shared_ptr<const Controller>& controller, int robots, const SensorNetwork& network) {
    std::vector<Obstacle> obstacles;
    for (int i = 0; i < 15; ++i) obstacles.push_back(post(std::to_string(i), 4 * towards(0.42 * i)));
    Environment environment;
    environment.obstacles = std::move(obstacles);
    SmallWorld world(std::move(environment));
    const SensorPointer camera = cameraOf(network);
    for (int i = 0; i < robots; ++i)
        world.robot(filming(camera), {1.5 * std::cos(1.3 * i), 1.5 * std::sin(1.3 * i), 2.0 * i}, controller, ideal(),
                    i % 5);
    return world;
}

TEST(LearnedCamera, GoesOnToTheSameBitsFromEveryTick) {
    const Scenario scenario =
        driving(std::make_shared<const RandomCommands>(-0.2, 0.4, 1), 4, noisyNetwork()).scenario();
    WorldState state = scenario.initialState(9);
    StepBuffers buffers, others;
    StepTrace trace, again;
    for (int k = 0; k < 300; ++k) {
        auto restored = parseState(stateBytes(state), "saved");
        ASSERT_TRUE(restored);
        step(scenario, state, buffers, {}, &trace);
        step(scenario, *restored, others, {}, &again);
        ASSERT_EQ(hashOf(state), hashOf(*restored)) << k;
        for (std::size_t i = 0; i < 4; ++i)
            if (trace.robots[i].observed) {
                ASSERT_EQ(trace.robots[i].observation, again.robots[i].observation) << k;
            }
    }
}

class FilmReader final : public Controller {
public:
    explicit FilmReader(const Attention& attention) : attention_(attention) {}
    Attention attention() const override { return attention_; }
    void decide(const Observation& observation, std::span<std::byte>, Decision& decision) const override {
        decision.command = Command{0.2, observation.time / (3000 * millisecond) % 2 == 0 ? -0.5 : 0.5};
    }

private:
    Attention attention_;
};

TEST(LearnedCamera, WhatItRemembersIsTheSameWhateverIsRead) {
    const auto scenarioOf = [](const Attention& attention) {
        return driving(std::make_shared<const FilmReader>(attention), 3, noisyNetwork()).scenario();
    };
    const Scenario all = scenarioOf({}), none = scenarioOf(Attention::ofItself()),
                   robots = scenarioOf(Attention::only({robotsName}));
    WorldState first = all.initialState(3), second = none.initialState(3), third = robots.initialState(3);
    StepBuffers one, two, three;
    StepTrace trace, of;
    for (int k = 0; k < 250; ++k) {
        step(all, first, one, {}, &trace);
        step(none, second, two);
        step(robots, third, three, {}, &of);
        ASSERT_EQ(hashOf(first), hashOf(second)) << k;
        ASSERT_EQ(hashOf(first), hashOf(third)) << k;
        if (!trace.robots[0].observed) continue;
        const auto seen = trace.robots[0].observation.records<SeenBody>(robotsName);
        EXPECT_TRUE(std::ranges::equal(seen, of.robots[0].observation.records<SeenBody>(robotsName)));
        EXPECT_EQ(of.robots[0].observation.find(landmarksName), nullptr);
    }
}

/// A robot that is never in view changes nothing of what is reported.
TEST(LearnedCamera, ReportsTheSameAloneAndAmongOthers) {
    const SensorPointer camera = cameraOf(noisyNetwork());
    const std::vector<Obstacle> posts{post("a", {2, 0.4}), post("b", {3, -0.7})};
    const auto alone = looks(filmed(camera, posts).scenario(), 100);
    std::vector<Pose> behind;
    for (int i = 0; i < 100; ++i) behind.push_back({-1.0 - i, 0, 0});
    const auto among = looks(filmed(camera, posts, behind).scenario(), 100);
    for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(alone[i].landmarks, among[i].landmarks) << i;
}

TEST(LearnedCamera, IsThatOfTheRobotThatItIs) {
    SensorNetwork network = cameraNetworkBy(2);
    network.learned.inputs[2].mean = 0.5;
    const auto seen = [&](const LearnedCamera::Options& options, const std::string& motionRobot) {
        SmallWorld world = filmed(cameraOf(network, options), {post("a", {2, 0})});
        world.parts().scene.robots[0].motionRobot = motionRobot;
        const auto all = looks(world.scenario(), 200);
        return static_cast<int>(
            std::ranges::count_if(all, [](const CameraLook& look) { return !look.landmarks.empty(); }));
    };
    EXPECT_EQ(seen({}, "a"), 200);
    EXPECT_EQ(seen({}, "b"), 0);
    EXPECT_EQ(seen({"b", std::nullopt}, "a"), 0) << "what its own key says";
    for (const int mean : {seen({}, ""), seen({}, "z")}) EXPECT_NEAR(mean, 100, 35) << "the mean of both";
}

TEST(LearnedCamera, WhatItRemembersAndReportsIsAQuantity) {
    const Scenario scenario = filmed(cameraOf(noisyNetwork()), {post("a", {2, 0})}).scenario();
    WorldState state = scenario.initialState(4);
    StepBuffers buffers;
    StepTrace trace;
    std::vector<RobotInsight> insights(1);
    for (int k = 0; k < 13; ++k) {
        const std::vector<std::byte> before = state.memory;
        step(scenario, state, buffers, {}, &trace);
        noteInsights(scenario, trace, state.tick, before, insights);
    }
    for (const char* const name : {"slow_reported", "slow_range", "slow_bearing"}) {
        const auto value = boundValue(scenario, {"camera", "1", name});
        ASSERT_TRUE(value) << value.error().message();
        EXPECT_NE(value->shownNumber(Moment{&scenario, &state}), 0);
    }
    const auto count = boundValue(scenario, {"camera", "1", "landmarks"});
    ASSERT_TRUE(count) << count.error().message();
    const Sensor& camera = *scenario.sensors(0)[3];
    EXPECT_TRUE(camera.sound(scenario.sensorMemory(state, 0, 3)));
    as<LearnedCamera::Memory>(scenario.sensorMemory(state, 0, 3)).slow[1] = std::nanf("");
    EXPECT_FALSE(camera.sound(scenario.sensorMemory(state, 0, 3)));
}

}  // namespace
}  // namespace mrose
