#include "scenario/variation.h"

#include <functional>

#include <gtest/gtest.h>

#include "experiment/trial_world.h"
#include "scenario/start_check.h"
#include "simulation/small_world.h"

namespace mrose {
namespace {

constexpr std::uint32_t trials = 4000;

/// Robots and boxes far from one another in the open: nothing overlaps, so that each first draw counts.
ScenarioParts openWorld() {
    SmallWorld world;
    world.robot(discRobot(), {0, 0, 0}, std::make_shared<const Told>(Command{}), ideal())
        .robot(discRobot(), {50, 3, 1}, std::make_shared<const Told>(Command{}), ideal())
        .object(ballType(), {0, 50, 0})
        .object(boxType(), {50, 50, 0.4});
    ScenarioParts parts = std::move(world.parts());
    parts.variation = {0.3, 0.5, 0.2, 0.25, 0.4};
    return parts;
}

Scene sceneOf(const ScenarioParts& parts, std::uint32_t trial) {
    const auto trialParts = varied(parts, trial);
    EXPECT_TRUE(trialParts) << trialParts.error().message();
    return trialParts ? trialParts->scene : Scene{};
}

std::vector<Pose> startsOf(const Scene& scene) {
    std::vector<Pose> starts;
    for (const SceneRobot& robot : scene.robots) starts.push_back(robot.start);
    for (const SceneObject& object : scene.objects) starts.push_back(object.start);
    return starts;
}

TEST(Variation, TrialZeroIsTheScenarioItself) {
    const ScenarioParts parts = openWorld();
    const Scene scene = sceneOf(parts, 0);
    EXPECT_EQ(startsOf(scene), startsOf(parts.scene));
    EXPECT_EQ(scene.environment.floor.slidingFriction, parts.scene.environment.floor.slidingFriction);
    EXPECT_EQ(scene.objectTypes[0].mass, parts.scene.objectTypes[0].mass);
}

TEST(Variation, SameTrialIsTheSameAndOthersAreNot) {
    const ScenarioParts parts = openWorld();
    for (std::uint32_t trial = 1; trial < 50; ++trial) {
        const std::vector<Pose> starts = startsOf(sceneOf(parts, trial));
        EXPECT_EQ(startsOf(sceneOf(parts, trial)), starts);
        const std::vector<Pose> next = startsOf(sceneOf(parts, trial + 1));
        for (std::size_t i = 0; i < starts.size(); ++i) EXPECT_NE(starts[i].x, next[i].x) << trial;
    }
}

TEST(Variation, WithoutAnyTrialsAreTheScenario) {
    ScenarioParts parts = openWorld();
    parts.variation = {};
    for (std::uint32_t trial = 1; trial < 10; ++trial)
        EXPECT_EQ(startsOf(sceneOf(parts, trial)), startsOf(parts.scene));
}

/// What is drawn in each trial, over +-1, by what it is called.
using Measure = std::function<double(const Scene&)>;
std::vector<std::pair<std::string, Measure>> measures(const ScenarioParts& parts) {
    const Variation& v = parts.variation;
    const Scene& own = parts.scene;
    const auto robot = [&](std::size_t i) {
        return [&own, i](const Scene& s) { return std::pair(s.robots[i].start, own.robots[i].start); };
    };
    const auto object = [&](std::size_t i) {
        return [&own, i](const Scene& s) { return std::pair(s.objects[i].start, own.objects[i].start); };
    };
    std::vector<std::pair<std::string, Measure>> all;
    const auto add = [&](const std::string& name, auto poses, double position, double heading) {
        all.emplace_back(name + " x",
                         [=](const Scene& s) { return (poses(s).first.x - poses(s).second.x) / position; });
        all.emplace_back(name + " y",
                         [=](const Scene& s) { return (poses(s).first.y - poses(s).second.y) / position; });
        if (heading > 0)
            all.emplace_back(name + " heading", [=](const Scene& s) {
                return (poses(s).first.heading - poses(s).second.heading) / heading;
            });
    };
    for (const std::size_t i : {0, 1}) {
        add("robot " + std::to_string(i), robot(i), v.robotPosition, v.robotHeading);
        add("object " + std::to_string(i), object(i), v.objectPosition, 0);
    }
    all.emplace_back("friction", [&](const Scene& s) {
        return (s.environment.floor.slidingFriction / own.environment.floor.slidingFriction - 1) / v.frictionShare;
    });
    all.emplace_back(
        "mass", [&](const Scene& s) { return (s.objectTypes[0].mass / own.objectTypes[0].mass - 1) / v.massShare; });
    return all;
}

/// Uniform over +-1: mean 0 and variance 1/3, of whose estimates the standard deviations are known; a tenth of the
/// draws in each tenth of the range; and each draw by itself.
TEST(Variation, DrawsAreUniformWithinTheirBoundsAndIndependent) {
    const ScenarioParts parts = openWorld();
    const auto all = measures(parts);
    std::vector<std::vector<double>> drawn(all.size());
    for (std::uint32_t trial = 1; trial <= trials; ++trial) {
        const Scene scene = sceneOf(parts, trial);
        for (std::size_t m = 0; m < all.size(); ++m) drawn[m].push_back(all[m].second(scene));
    }
    const double n = trials;
    for (std::size_t m = 0; m < all.size(); ++m) {
        double sum = 0, squares = 0;
        std::vector<int> tenths(10);
        for (const double value : drawn[m]) {
            ASSERT_LT(std::abs(value), 1 + 1e-9) << all[m].first;
            sum += value;
            squares += value * value;
            ++tenths[static_cast<std::size_t>(std::min(9.0, (value + 1) * 5))];
        }
        EXPECT_LT(std::abs(sum / n), 5 * std::sqrt(1 / (3 * n))) << all[m].first;
        EXPECT_NEAR(squares / n, 1.0 / 3, 5 * std::sqrt((1.0 / 5 - 1.0 / 9) / n)) << all[m].first;
        for (const int count : tenths) EXPECT_NEAR(count, n / 10, 5 * std::sqrt(n * 0.09)) << all[m].first;
        for (std::size_t other = 0; other < m; ++other) {
            double product = 0;
            for (std::size_t i = 0; i < drawn[m].size(); ++i) product += drawn[m][i] * drawn[other][i];
            EXPECT_LT(std::abs(product / n), 5 / (3 * std::sqrt(n))) << all[m].first << " and " << all[other].first;
        }
    }
}

TEST(Variation, FloorsFrictionsVaryTogetherAndSoDoMasses) {
    const ScenarioParts parts = openWorld();
    const Scene& own = parts.scene;
    for (std::uint32_t trial = 1; trial < 20; ++trial) {
        const Scene scene = sceneOf(parts, trial);
        const FloorSurface& floor = scene.environment.floor;
        EXPECT_NEAR(floor.slidingFriction / own.environment.floor.slidingFriction,
                    floor.rollingDeceleration / own.environment.floor.rollingDeceleration, 1e-12);
        EXPECT_EQ(floor.traction, own.environment.floor.traction) << "that is the robots' own";
        EXPECT_NEAR(scene.objectTypes[0].mass / own.objectTypes[0].mass,
                    scene.objectTypes[1].mass / own.objectTypes[1].mass, 1e-12);
        EXPECT_EQ(scene.robotTypes[0].mass, own.robotTypes[0].mass);
        EXPECT_EQ(scene.objects[1].start.heading, own.objects[1].start.heading);
    }
}

/// Two robots whose starts overlap in about every third draw.
TEST(Variation, OverlapsAreDrawnAgain) {
    SmallWorld world;
    world.robot(discRobot(0.2), {0, 0, 0}, std::make_shared<const Told>(Command{}), ideal())
        .robot(discRobot(0.2), {0.45, 0, 0}, std::make_shared<const Told>(Command{}), ideal());
    ScenarioParts parts = std::move(world.parts());
    parts.variation.robotPosition = 0.2;
    double nearest = 1;
    for (std::uint32_t trial = 1; trial <= 500; ++trial) {
        const Scene scene = sceneOf(parts, trial);
        EXPECT_FALSE(findStartOverlap(scene)) << trial;
        nearest = std::min(nearest, distance(position(scene.robots[0].start), position(scene.robots[1].start)));
        for (const std::size_t i : {0, 1}) EXPECT_LE(std::abs(scene.robots[i].start.y), 0.2);
    }
    EXPECT_LT(nearest, 0.41) << "draws reach where they would overlap";
}

/// A thin wall through the middle, over which every second draw would jump.
TEST(Variation, NoBodyStartsBehindAWall) {
    SmallWorld world(walledField(20, 20));
    world.robot(discRobot(0.1), {9.7, 10, 0}, std::make_shared<const Told>(Command{}), ideal())
        .object(ballType(), {10.4, 12, 0});
    ScenarioParts parts = std::move(world.parts());
    Obstacle wall;
    wall.shape = Shape::fromParts("wall", {{"", {{9.99, 1}, {10.01, 1}, {10.01, 19}, {9.99, 19}}}});
    wall.wall = true;
    parts.scene.environment.obstacles.push_back(wall);
    parts.variation.robotPosition = 2;
    parts.variation.objectPosition = 1;
    double low = 20, high = 0;
    for (std::uint32_t trial = 1; trial <= 300; ++trial) {
        const Scene scene = sceneOf(parts, trial);
        EXPECT_LT(scene.robots[0].start.x, 9.99) << trial;
        EXPECT_GT(scene.objects[0].start.x, 10.01) << trial;
        low = std::min(low, scene.robots[0].start.x);
        high = std::max(high, scene.objects[0].start.x);
    }
    EXPECT_LT(low, 8) << "the rest is drawn as ever";
    EXPECT_GT(high, 11.2);
    parts.scene.environment.obstacles.back().wall = false;
    int behind = 0;
    for (std::uint32_t trial = 1; trial <= 300; ++trial) behind += sceneOf(parts, trial).robots[0].start.x > 10 ? 1 : 0;
    EXPECT_GT(behind, 50) << "of what is no wall either side is as good";
}

TEST(Variation, WhereHundredDrawsOverlapThatIsSaid) {
    SmallWorld world(walledField(0.41, 0.41));
    world.robot(discRobot(0.2), {0.205, 0.205, 0}, std::make_shared<const Told>(Command{}), ideal());
    ScenarioParts parts = std::move(world.parts());
    parts.name = "narrow";
    parts.variation.robotPosition = 0.15;
    EXPECT_TRUE(varied(parts, 0));
    const auto trial = varied(parts, 7);
    ASSERT_FALSE(trial);
    EXPECT_EQ(trial.error().message(),
              "narrow: in a hundred draws of trial 7 bodies have overlapped or begun behind a wall; "
              "expected less variation, or more room");
}

}  // namespace
}  // namespace mrose
