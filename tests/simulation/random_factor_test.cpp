// The random factor varies restitution and friction of each touching pair once a tick: evenly, by the pair's key.
#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "simulation/small_world.h"
#include "support/outlines.h"
#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

constexpr double share = 0.1, sameFactor = 1e-6;

/// What a pair's restitution or friction is multiplied by in a tick; `other` is noBody for what stands still.
double pairFactor(std::uint64_t seed, std::int64_t tick, std::uint32_t body, std::uint32_t other, NoiseChannel what) {
    const std::uint32_t channel = channelOf(what, other == noBody ? 0 : other + 1);
    return 1 + share * (2 * uniformNoise({seed, tick, body, channel}) - 1);
}

/// Smallest distance of the empirical distribution of uniform draws in (least, most) that one run in a thousand
/// exceeds (Kolmogorov), as a share of it.
double kolmogorovRatio(std::vector<double> values, double least, double most) {
    std::sort(values.begin(), values.end());
    const auto count = static_cast<double>(values.size());
    double farthest = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double uniform = std::clamp((values[i] - least) / (most - least), 0.0, 1.0);
        const double below = static_cast<double>(i) / count, upTo = static_cast<double>(i + 1) / count;
        farthest = std::max({farthest, std::abs(uniform - below), std::abs(upTo - uniform)});
    }
    return farthest * std::sqrt(count) / 1.95;
}

void expectEven(const std::vector<double>& values, double nominal) {
    ASSERT_GE(values.size(), 500u);
    const double least = (1 - share) * nominal, most = (1 + share) * nominal;
    EXPECT_LT(kolmogorovRatio(values, least, most), 1);
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
    EXPECT_GE(*lowest, least - sameFactor);
    EXPECT_LE(*highest, most + sameFactor);
    const auto nominals =
        std::count_if(values.begin(), values.end(), [&](double value) { return std::abs(value / nominal - 1) < 1e-9; });
    EXPECT_EQ(nominals, 0) << "kept the nominal value";
}

/// A ball thrown towards +x at the east wall of a field of 4 m, its edge `before` m off it.
Scenario thrownAtWall(double before, const Twist& velocity, double friction) {
    SmallWorld world(onIce(walledField(4, 40, {friction, 0})));
    world.parts().scene.randomFactor = share;
    world.object(rollingBody(0.11, 0.43, {friction, 0.5}), {4 - 0.11 - before, 20, 0}, velocity);
    return world.scenario();
}

/// Steps until the first object has touched something; the tick in which it did.
std::optional<std::int64_t> stepToTouch(const Scenario& scenario, WorldState& state) {
    StepBuffers buffers;
    StepTrace trace;
    for (int k = 0; k < 100; ++k) {
        const std::int64_t tick = state.tick;
        step(scenario, state, buffers, {}, &trace);
        if (trace.touchedObjects[0]) return tick;
    }
    return std::nullopt;
}

TEST(RandomFactor, RestitutionAtAWallIsEvenAtAnySpeed) {
    for (const double speed : {1.0, 5.0, 9.0, 12.0}) {
        SCOPED_TRACE(speed);
        std::vector<double> restitutions;
        for (int i = 0; i < 20; ++i) {
            const Scenario scenario = thrownAtWall(0.011 + 0.037 * i, {speed, 0, 0}, 0);
            for (int k = 1; k <= 40; ++k) {
                const auto seed = static_cast<std::uint64_t>(40 * i + k);  // many throws hit in the same tick
                WorldState state = scenario.initialState(seed);
                const auto tick = stepToTouch(scenario, state);
                ASSERT_TRUE(tick);
                restitutions.push_back(-state.objects[0].velocity_W.x / speed);
                const double factor = pairFactor(seed, *tick, 0, noBody, NoiseChannel::restitution);
                EXPECT_NEAR(restitutions.back(), 0.5 * factor, sameFactor) << seed << ", tick " << *tick;
            }
        }
        expectEven(restitutions, 0.5);
    }
}

/// A sliding hit: the tangential impulse is friction times the normal one, and both have their own factor.
TEST(RandomFactor, FrictionAtAWallIsEvenAtAnySpeed) {
    for (const double speed : {1.0, 5.0, 9.0, 12.0}) {
        SCOPED_TRACE(speed);
        std::vector<double> frictions;
        for (int i = 0; i < 20; ++i) {
            const Scenario scenario = thrownAtWall(0.011 + 0.037 * i, {speed, 2 * speed, 0}, 0.2);
            for (int k = 1; k <= 40; ++k) {
                const auto seed = static_cast<std::uint64_t>(40 * i + k);
                WorldState state = scenario.initialState(seed);
                const auto tick = stepToTouch(scenario, state);
                ASSERT_TRUE(tick);
                const Twist& after = state.objects[0].velocity_W;
                const double bounce = 0.5 * pairFactor(seed, *tick, 0, noBody, NoiseChannel::restitution);
                const double factor = pairFactor(seed, *tick, 0, noBody, NoiseChannel::contactFriction);
                EXPECT_NEAR(after.y, 2 * speed - 0.2 * factor * (1 + bounce) * speed, sameFactor * speed) << seed;
                frictions.push_back((2 * speed - after.y) / (speed - after.x));
            }
        }
        expectEven(frictions, 0.2);
    }
}

/// A ball between two walls of other restitutions, and how its speed must end by events in closed form.
struct Channel {
    double gap;        ///< m, that is left to the ball
    double bounce[2];  ///< restitutions of the walls at its low and its high end
};

struct Rattled {
    double velocity = 0;
    int bounces = 0;
    double margin = 1e9;  ///< s, from the tick's end to the nearest bounce
};

/// One tick from `at` (0 ... gap) with factors of the walls.
Rattled rattle(const Channel& channel, double at, double velocity, double factor, double duration) {
    Rattled result{velocity};
    double left = duration;
    for (;;) {
        const int wall = result.velocity > 0 ? 1 : 0;
        const double way = wall == 1 ? channel.gap - at : at, time = way / std::abs(result.velocity);
        result.margin = std::min(result.margin, std::abs(time - left));
        if (time >= left) return result;
        result.margin = std::min(result.margin, left - time);
        left -= time;
        at = wall == 1 ? channel.gap : 0;
        result.velocity *= -std::min(1.0, channel.bounce[wall] * factor);
        ++result.bounces;
    }
}

TEST(RandomFactor, BouncesWithinATickShareTheirPairsFactor) {
    const Channel channel{0.05, {0.9, 0.7}};
    Environment place = onIce();
    addObstacle(place, "low", {{-0.31, -2}, {-0.11, -2}, {-0.11, 2}, {-0.31, 2}}, {0, channel.bounce[0]});
    const double end = channel.gap + 0.11;
    addObstacle(place, "high", {{end, -2}, {end + 0.2, -2}, {end + 0.2, 2}, {end, 2}}, {0, channel.bounce[1]});
    int several = 0, compared = 0;
    for (const double speed : {5.0, 9.0, 12.0})
        for (int i = 0; i < 8; ++i) {
            const double start = 0.003 + 0.006 * i;
            SmallWorld world(place);
            world.parts().scene.randomFactor = share;
            world.object(rollingBody(0.11, 0.43, {0, 0}), {start, 0, 0}, {speed, 0, 0});
            const Scenario scenario = world.scenario();
            for (std::uint64_t seed = 1; seed <= 20; ++seed) {
                WorldState state = scenario.initialState(seed);
                const double factor = pairFactor(seed, 0, 0, noBody, NoiseChannel::restitution);
                const Rattled expected = rattle(channel, start, speed, factor, 0.02);
                run(scenario, state, 1);
                if (expected.margin * speed < 0.003) continue;  // the last bounce may be in the next tick
                ++compared;
                several += expected.bounces >= 3 ? 1 : 0;
                EXPECT_NEAR(state.objects[0].velocity_W.x, expected.velocity, sameFactor * speed)
                    << speed << " m/s from " << start << ", seed " << seed << ": " << expected.bounces << " bounces";
            }
        }
    EXPECT_GT(compared, 300);
    EXPECT_GT(several, 100);
}

/// Head-on, of unequal masses: the pair's factor is drawn by both numbers, the lower one first.
TEST(RandomFactor, RestitutionOfTwoBodiesIsEven) {
    for (const bool lightFirst : {true, false})
        for (const double speed : {1.0, 9.0}) {
            SCOPED_TRACE(speed);
            std::vector<double> restitutions;
            for (int i = 0; i < 15; ++i) {
                const double before = 0.011 + 0.037 * i;
                const ObjectType ball = rollingBody(0.11, 0.43, {0, 0.5});
                const ObjectType post = slidingBody(discOutline(0.2), 7, {0, 0.3});
                const Pose left{-0.31 - before, 0, 0}, right{0, 0, 0};
                SmallWorld world(onIce());
                world.parts().scene.randomFactor = share;
                if (lightFirst)
                    world.object(ball, left, {speed, 0, 0}).object(post, right);
                else
                    world.object(post, right).object(ball, left, {speed, 0, 0});
                const Scenario scenario = world.scenario();
                for (std::uint64_t seed = 1; seed <= 40; ++seed) {
                    WorldState state = scenario.initialState(seed);
                    const auto tick = stepToTouch(scenario, state);
                    ASSERT_TRUE(tick);
                    const double thrown = state.objects[lightFirst ? 0 : 1].velocity_W.x;
                    const double hit = state.objects[lightFirst ? 1 : 0].velocity_W.x;
                    restitutions.push_back((hit - thrown) / speed);
                    const double factor = pairFactor(seed, *tick, 0, 1, NoiseChannel::restitution);
                    EXPECT_NEAR(restitutions.back(), 0.5 * factor, sameFactor) << seed;
                    EXPECT_NEAR(0.43 * thrown + 7 * hit, 0.43 * speed, 1e-5);
                }
            }
            expectEven(restitutions, 0.5);
        }
}

TEST(RandomFactor, RestitutionAtAStandingRobotIsEven) {
    std::vector<double> restitutions;
    for (int i = 0; i < 15; ++i) {
        SmallWorld world(onIce());
        world.parts().scene.randomFactor = share;
        world.robot(robotOf(discOutline(0.2), 7, {0, 0.5}), {0, 0, 0}, std::make_shared<const Told>(Command{}),
                    ideal());
        world.object(rollingBody(0.11, 0.43, {0, 0.2}), {0.31 + 0.011 + 0.037 * i, 0, 0}, {-8, 0, 0});
        const Scenario scenario = world.scenario();
        for (std::uint64_t seed = 1; seed <= 40; ++seed) {
            WorldState state = scenario.initialState(seed);
            const auto tick = stepToTouch(scenario, state);
            ASSERT_TRUE(tick);
            restitutions.push_back((state.objects[0].velocity_W.x - state.robots[0].velocity_B.x) / 8);
            const double factor = pairFactor(seed, *tick, 0, 1, NoiseChannel::restitution);
            EXPECT_NEAR(restitutions.back(), 0.5 * factor, sameFactor) << seed;
        }
    }
    expectEven(restitutions, 0.5);
}

}  // namespace
}  // namespace mrose
