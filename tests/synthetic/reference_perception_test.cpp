#include "synthetic/reference_perception.h"

#include <cmath>
#include <map>
#include <numbers>

#include "sensing/perceiving.h"
#include "support/units.h"
#include "synthetic/reference_self.h"
#include "synthetic/reference_sight.h"
#include "synthetic/world_landmarks.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

const Pose standing{3, 2, 0.4};

Perception referencePerception(double scale = 1) {
    Perception perception;
    perception.model = Perception::Model::reference;
    perception.errorScale = scale;
    perception.self.latency = 100 * ms;
    return perception;
}

Environment goalField() {
    Environment field = walledField(9, 5);
    field.goals.push_back({"west", {{-0.1, 1.5}, {0.3, 1.5}, {0.3, 3.5}, {-0.1, 3.5}}});
    field.goals.push_back({"east", {{8.7, 1.5}, {9.1, 1.5}, {9.1, 3.5}, {8.7, 3.5}}});
    return field;
}

Scenario standingRobot(double scale = 1) {
    return SmallWorld(goalField()).robot(perceiving(referencePerception(scale)), standing, still(), ideal()).scenario();
}

struct Sums {
    double count = 0, sum = 0, squares = 0;
    void add(double x) { count += 1, sum += x, squares += x * x; }
    double mean() const { return sum / count; }
    double deviation() const { return std::sqrt(squares / count - mean() * mean()); }
};

TEST(ReferenceSelf, ErrsByCentimetresAndDegreesThatLast) {
    const Scenario scenario = standingRobot();
    SensorWatch watch(scenario, 5);
    std::vector<double> x;
    Sums position, heading;
    int reports = 0, missing = 0, gross = 0;
    Nanoseconds last = -second;
    for (int i = 0; i < 40000; ++i) {
        const Observation& seen = watch.next();
        missing += seen.selfMeasured() == last ? 1 : 0;
        if (seen.selfMeasured() == last) continue;
        last = seen.selfMeasured();
        ++reports;
        const Pose self = seen.self();
        if (std::hypot(self.x - standing.x, self.y - standing.y) > 0.35) {
            ++gross;
            continue;
        }
        x.push_back(self.x - standing.x);
        position.add(self.x - standing.x);
        heading.add(self.heading - standing.heading);
    }
    EXPECT_GT(position.deviation(), 0.03);
    EXPECT_LT(position.deviation(), 0.12);
    EXPECT_GT(heading.deviation(), 0.015);
    EXPECT_LT(heading.deviation(), 0.07);
    const ReferenceLocaliserParameters p;
    // The share of the time that bursts take, which begin at a rate and last their mean.
    const double share = p.burstRate * p.burstLength / (1 + p.burstRate * p.burstLength);
    EXPECT_NEAR(missing / 40000.0, share, 0.006);
    EXPECT_NEAR(static_cast<double>(gross) / reports, p.jump + p.mirrored, 0.002);
    double apart = 0;
    const std::size_t second = 10;  // reports
    for (std::size_t i = second; i < x.size(); ++i)
        apart += (x[i] - position.mean()) * (x[i - second] - position.mean());
    apart /= static_cast<double>(x.size()) * position.deviation() * position.deviation();
    EXPECT_GT(apart, 0.2) << "errors last";
    EXPECT_LT(apart, 0.6);
}

/// As large at the first measurement of many runs as later in one.
TEST(ReferenceSelf, IsStationaryFromTheFirstMeasurementOn) {
    const Scenario scenario = standingRobot();
    Sums first, later;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        SensorWatch watch(scenario, seed);
        const auto add = [&](Sums& sums) {
            const Observation& seen = watch.next();
            const double off = seen.localised() ? seen.self().x - standing.x : 0;
            if (std::abs(off) < 0.35 && seen.localised()) sums.add(off);
        };
        add(first);
        for (int i = 0; i < 30; ++i) watch.next();
        add(later);
    }
    EXPECT_NEAR(first.deviation() / later.deviation(), 1, 0.08);
}

TEST(ReferenceSelf, ScaleIsThatOfItsErrors) {
    const Scenario whole = standingRobot(), half = standingRobot(0.5), none = standingRobot(0);
    SensorWatch a(whole, 3), b(half, 3), c(none, 3);
    for (int i = 0; i < 200; ++i) {
        const Pose one = a.next().self(), two = b.next().self(), exact = c.next().self();
        if (std::hypot(exact.x - standing.x, exact.y - standing.y) > 0.1) continue;  // gross
        EXPECT_EQ(exact, standing);
        EXPECT_NEAR(two.x - standing.x, (one.x - standing.x) / 2, 1e-12);
        EXPECT_NEAR(two.heading - standing.heading, (one.heading - standing.heading) / 2, 1e-12);
    }
}

TEST(WorldLandmarks, AreThoseOfTheEnvironmentOrWhatStandsThere) {
    const WorldLandmarks field = worldLandmarks(goalField());
    EXPECT_EQ(field.points.size(), 4u + 2 + 8 + 4);
    EXPECT_NEAR(field.middle.x, 4.5, 1e-9);
    EXPECT_NEAR(field.middle.y, 2.5, 1e-9);
    Environment posts;
    for (const double x : {0.0, 1.0, 2.0}) {
        ShapePart post;
        post.centre = {x, 3};
        post.radius = 0.1;
        Obstacle obstacle{"post", Shape::fromParts("post", {post}), {}};
        obstacle.landmark = std::to_string(x);
        posts.obstacles.push_back(std::move(obstacle));
    }
    const WorldLandmarks named = worldLandmarks(posts);
    ASSERT_EQ(named.points.size(), 3u);
    EXPECT_NEAR(named.points[2].x, 2, 1e-9);
    EXPECT_TRUE(worldLandmarks({}).points.empty());
}

/// One robot that looks at a ball at a range and bearing.
Scenario lookingAt(double range, double bearing, double scale = 1) {
    Perception perception = referencePerception(scale);
    perception.objects.fieldOfView = std::numbers::pi / 2;
    SmallWorld world;
    world.robot(perceiving(perception), {}, still(), ideal());
    world.object(ballType(), {range * std::cos(bearing), range * std::sin(bearing), 0});
    return world.scenario();
}

/// What is left of Laplace's distribution about `middle` when it is known in steps alone: each step with what of the
/// distribution is nearest to it.
Sums roundedLaplace(double middle, double deviation, double step) {
    const double scale = deviation / std::numbers::sqrt2;
    const auto below = [&](double x) {
        const double off = (x - middle) / scale;
        return off < 0 ? 0.5 * std::exp(off) : 1 - 0.5 * std::exp(-off);
    };
    Sums sums;
    for (double at = step * std::round(middle / step - 60 / step); at < middle + 60; at += step) {
        const double weight = below(at + step / 2) - below(at - step / 2);
        sums.count += weight, sums.sum += weight * at, sums.squares += weight * at * at;
    }
    return sums;
}

TEST(ReferenceSight, ReportsColumnsAndHeightsInWholePixels) {
    const double range = 2.5, bearing = -0.2;
    const Scenario scenario = lookingAt(range, bearing);
    SensorWatch watch(scenario, 7);
    const ReferenceSightParameters p;
    const double high = p.pixelsPerRadian * 2 * ballType().shape->reach;
    Sums pixels, columns;
    int looks = 0, gross = 0;
    const auto isWhole = [](double x) { return std::abs(x - std::round(x)) < 1e-6; };
    for (; looks < 20000; ++looks)
        for (const SeenBody& body : watch.next().objects()) {
            const double column = p.pixelsPerRadian * direction(body.position_B), rows = high / length(body.position_B);
            if (isWhole(rows) && isWhole(column / p.column)) {
                columns.add(column);
                pixels.add(rows);
            } else {
                ++gross;  // anywhere, also between the pixels
            }
        }
    const double share = bearing / (std::numbers::pi / 4);
    const Sums expectedRows = roundedLaplace((1 + p.blooming) * high / range, p.heightNoise, 1);
    const Sums expectedColumns =
        roundedLaplace(p.pixelsPerRadian * bearing + p.lens * share * share * share, p.columnNoise, p.column);
    EXPECT_NEAR(pixels.mean(), expectedRows.mean(), 0.1) << "it appears too high, and so too near";
    EXPECT_NEAR(pixels.deviation(), expectedRows.deviation(), 0.1);
    EXPECT_NEAR(columns.mean(), expectedColumns.mean(), 0.07);
    EXPECT_NEAR(columns.deviation(), expectedColumns.deviation(), 0.07);
    const double glare = p.burstRate * p.burstLength / (1 + p.burstRate * p.burstLength);
    const double farther = 1 / (1 + std::exp((range - p.halfSeen) / p.halfSeenWidth));
    EXPECT_NEAR((pixels.count + gross) / looks, (1 - glare) * farther, 0.015);
    EXPECT_NEAR(gross / (pixels.count + gross), p.confused, 0.0015);
}

TEST(ReferenceSight, IsBlindBehindItsStrutAndFarAway) {
    const auto seen = [](double range, double bearing) {
        const Scenario scenario = lookingAt(range, bearing);
        SensorWatch watch(scenario, 9);
        int count = 0;
        for (int i = 0; i < 4000; ++i) count += static_cast<int>(watch.next().objects().size());
        return count / 4000.0;
    };
    EXPECT_EQ(seen(2, 0.275), 0);
    EXPECT_GT(seen(2, 0.35), 0.9);
    EXPECT_NEAR(seen(ReferenceSightParameters().halfSeen, 0.1), 0.485, 0.06);
    EXPECT_LT(seen(10, 0.1), 0.01);
}

TEST(ReferenceSight, WithoutErrorsIsExactButForGrossOnes) {
    const Scenario scenario = lookingAt(2, 0.1, 0);
    SensorWatch watch(scenario, 2);
    int exact = 0, count = 0;
    for (int i = 0; i < 1000; ++i)
        for (const SeenBody& body : watch.next().objects()) {
            ++count;
            exact += distance(body.position_B, {2 * std::cos(0.1), 2 * std::sin(0.1)}) < 1e-9 ? 1 : 0;
        }
    EXPECT_GT(count, 800);
    EXPECT_GT(exact, count - 12);
}

/// Three that drive about and see each other and a ball.
Scenario drivingOnes(bool attentive = true) {
    SmallWorld world(walledField(4, 3));
    Perception perception = referencePerception();
    perception.objects.latency = perception.robots.latency = 60 * ms;
    perception.objects.occlusion = true;
    const auto commands = std::make_shared<const RandomCommands>(-0.2, 0.6, 2);
    const std::shared_ptr<const Controller> controller = commands;
    for (std::uint32_t i = 0; i < 3; ++i)
        world.robot(perceiving(perception), {0.7 + i, 0.8 + 0.5 * i, 1.0 * i},
                    attentive ? controller : std::make_shared<const Told>(Command{0.3, 0.5}), ideal(), i);
    world.object(ballType(), {2, 2.4, 0}, {0.4, -0.3, 0});
    return world.scenario();
}

TEST(ReferencePerception, IsRewoundFromEveryTickToTheSameBits) {
    const Scenario scenario = drivingOnes();
    WorldState state = scenario.initialState();
    std::vector<WorldState> kept;
    for (int i = 0; i < 150; ++i) {
        kept.push_back(state);
        run(scenario, state, 1);
    }
    for (const WorldState& from : kept) {
        WorldState again = from;
        run(scenario, again, static_cast<int>(state.tick - from.tick));
        ASSERT_EQ(stateBytes(again), stateBytes(state)) << from.tick;
    }
}

TEST(ReferencePerception, AnotherSeedSeesOtherwise) {
    const Scenario scenario = drivingOnes(false);
    WorldState one = scenario.initialState(1), two = scenario.initialState(2), again = scenario.initialState(1);
    for (WorldState* state : {&one, &two, &again}) run(scenario, *state, 20);
    EXPECT_EQ(stateBytes(one), stateBytes(again));
    EXPECT_NE(one.sensing, two.sensing);
}

TEST(ReferencePerception, ExplainsThatItIsSynthetic) {
    const Scenario scenario = drivingOnes();
    WorldState state = scenario.initialState();
    run(scenario, state, 20);
    for (std::size_t sensor = 0; sensor < 2; ++sensor) {
        const auto entries =
            explained(*scenario.sensors(0)[sensor], scenario.sensorMemory(std::as_const(state), 0, sensor));
        ASSERT_FALSE(entries.empty());
        EXPECT_EQ(entries[0].name, "synthetic");
        EXPECT_TRUE(scenario.sensors(0)[sensor]->sound(scenario.sensorMemory(std::as_const(state), 0, sensor)));
    }
}

}  // namespace
}  // namespace mrose
